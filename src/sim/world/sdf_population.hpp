// <population>: many copies of one model, spread over a region.
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "sim/world/sdf_xml.hpp"

namespace nbvopt {

/// Where the copies of a <population> stand in the map, as Gazebo spreads them: `random` and
/// `uniform` in a box or a cylinder, `grid` about the pose, `linear-x`, `-y`, `-z` along a box.
/// Copies keep the map's axes. Gazebo draws anew in every run; here `random` draws from the
/// generator, and `uniform`, which is to be even, takes the points of Halton's sequence. Throws
/// InputError for a region or a distribution that is not known, a bad value, or too many copies.
std::vector<Eigen::Vector3d> population_positions_m(const SdfElement& population,
                                                    std::mt19937_64& generator);

}  // namespace nbvopt
