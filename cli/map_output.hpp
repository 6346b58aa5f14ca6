// What the map commands tell of a map.
#pragma once

#include <string>

#include "core/json.hpp"
#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// What `nbvopt map info` tells of a map.
Json map_json(const UncertaintyMap& map);
std::string map_text(const UncertaintyMap& map);

}  // namespace nbvopt
