// What ways past places are worth.
#pragma once

#include <span>
#include <vector>

#include "nbvopt/sim/cell_array.hpp"
#include "sim/exploration/path.hpp"
#include "sim/exploration/view/place_panorama.hpp"
#include "sim/exploration/view/promises.hpp"

namespace nbvopt {

/// What the places that each way comes by bring, the one where it ends included: of every cube of
/// space the most that one of them sees there, since what was seen from one is not seen anew from
/// the next. Places by their squares, null where there is none; cubes are named by small numbers,
/// as PlaceGains does it. Ways that begin alike cost little more than the longest of them.
std::vector<double> information_along(std::span<const Path> ways,
                                      const CellArray<const PlaceGain*>& places,
                                      const Promises& promises);

}  // namespace nbvopt
