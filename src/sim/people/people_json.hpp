// People as JSON, in which caches and fingerprints of worlds know them.
#pragma once

#include "core/json.hpp"
#include "nbvopt/sim/people.hpp"

namespace nbvopt {

Json to_json(const People& people);

/// The way back, to the last bit. Throws nlohmann's exceptions.
People people_of(const Json& json);

}  // namespace nbvopt
