// Places for a robot, drawn from a map's free space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/plan.hpp"
#include "study/study.hpp"

namespace nbvopt::study {

/// Draws base poses at this height within the known part of the map, and joints within the mast's
/// limits, such that the camera stands in a free voxel. The first n of a seed are the same for
/// every count. None when so many are not found in a hundred thousand tries each.
std::optional<std::vector<Start>> sample_starts(const UncertaintyMap& map, const Mast& mast,
                                                double base_z_m, std::size_t count,
                                                std::uint64_t seed);

/// The base and the joints of a start as a request; its motion time is still to be set.
PlanRequest request_of(const Start& start);

}  // namespace nbvopt::study
