// The evaluator of every gain but `positive` and `expected` alone.
#pragma once

#include <memory>

#include "nbvopt/gain/view_evaluator.hpp"

namespace nbvopt::detail {

/// The weighted sum that the camera's options choose, by plain walks over all voxels of a view's
/// rays. In the ViewGain, a ray that meets an unknown voxel in range is an unknown one, and the
/// gain is not split into parts.
std::unique_ptr<ViewEvaluator> make_gain_sum_evaluator(const std::shared_ptr<const VoxelGrid>& grid,
                                                       const DepthCamera& camera,
                                                       const HazardTable& hazards);

}  // namespace nbvopt::detail
