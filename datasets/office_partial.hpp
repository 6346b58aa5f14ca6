// The map that ships as office_partial.ot.
#pragma once

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// The office as the paper's robot knows it after a short drive with its camera held still,
/// straight ahead at mid height. The same on every machine.
UncertaintyMap make_office_partial();

}  // namespace nbvopt
