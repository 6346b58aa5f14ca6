// A way to a place, and what it is worth.
#pragma once

#include <span>
#include <vector>

#include "sim/exploration/path.hpp"
#include "sim/exploration/view/place_panorama.hpp"

namespace nbvopt {

struct Way {
  Path path;
  double travel_s;
  std::vector<const PlaceGain*> places;  ///< that it passes, where it ends included
};

/// What ways past these places bring: of every cube of space the most that one of them sees there,
/// since what was seen from one is not seen anew from the next. Cubes are named by small numbers,
/// as PlaceGains does it.
double information_along(std::span<const PlaceGain* const> places);

/// What a way brings a second of driving and of looking around where it ends.
double information_per_s(const Way& way, double look_s);

}  // namespace nbvopt
