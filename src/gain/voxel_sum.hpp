// Eq. 13 over voxels, as smooth as it gets: each voxel once, with its best hit.
#pragma once

#include <cstdint>
#include <span>

#include "gain/panorama_layer.hpp"
#include "gain/panorama_sum.hpp"

namespace nbvopt::detail {

/// The sum over the voxels in view of min(1, n) times the best gain of their hits, n the expected
/// number of rays on the voxel; with its derivatives where they are asked for.
PanoramaSum voxel_sum(const PanoramaKernel& kernel, const PanoramaModel& model,
                      const PanoramaView& view, const PanoramaLayer& layer,
                      std::span<const std::uint32_t> blocks, bool with_motion);

}  // namespace nbvopt::detail
