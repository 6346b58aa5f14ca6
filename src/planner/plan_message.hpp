// The answer in plain words.
#pragma once

#include <string>

#include "nbvopt/map/voxel.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// What to do, what it gains, where the gain comes from and which joints hold it back. `result`
/// has its views and active bounds.
std::string gain_message(const PlanResult& result);

/// Why there is nothing to gain: `at_camera` is what the optical centre stands in, `view` the best
/// one.
std::string no_gain_message(VoxelState at_camera, const ViewGain& view);

}  // namespace nbvopt
