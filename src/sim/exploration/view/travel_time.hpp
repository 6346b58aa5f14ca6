// How long a base takes to drive along a path.
#pragma once

#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/path.hpp"

namespace nbvopt {

/// Seconds from a standing start with that heading to the path's end, as BaseMotion drives: at full
/// speed, but turning on the spot wherever the way lies more than 60 degrees aside. What
/// accelerating takes is left out.
double travel_time_s(const BaseOptions& base, double yaw_rad, const Path& path);

}  // namespace nbvopt
