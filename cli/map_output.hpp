// What the map commands write: formats by name, and what a map holds.
#pragma once

#include <string>

#include "core/json.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

/// The format of that name or, where it is empty, of the file's extension. Throws UsageError when
/// the extension tells none.
MapFormat output_format(const std::string& name, const std::string& file);

/// What `nbvopt map info` tells of a map.
Json map_json(const UncertaintyMap& map);
std::string map_text(const UncertaintyMap& map);

}  // namespace nbvopt
