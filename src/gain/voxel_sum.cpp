#include "gain/voxel_sum.hpp"

#include <algorithm>
#include <vector>

namespace nbvopt::detail {
namespace {

/// What is known of a voxel while its hits go by.
struct VoxelTally {
  double rays = 0.0;
  double best_gain = 0.0;
  std::size_t best_hit = 0;
};

}  // namespace

PanoramaSum voxel_sum(const PanoramaKernel& kernel, const PanoramaModel& model,
                      const PanoramaView& view, const PanoramaLayer& layer,
                      std::span<const std::uint32_t> ids, bool with_motion) {
  thread_local HitTerms terms;
  thread_local std::vector<VoxelTally> tallies;
  kernel.terms(model, view, layer.blocks(), ids, terms);
  tallies.assign(layer.voxel_count(), {});

  const auto for_each_hit = [&](const auto& visit) {
    std::size_t hit = 0;
    for (const std::uint32_t id : ids) {
      for (const std::uint32_t voxel : layer.voxels(id)) {
        if (terms.rays[hit] > 0.0) visit(hit, tallies[voxel]);
        ++hit;
      }
    }
  };
  for_each_hit([&](std::size_t hit, VoxelTally& tally) {
    tally.rays += terms.rays[hit];
    if (terms.gain[hit] <= tally.best_gain) return;
    tally.best_gain = terms.gain[hit];
    tally.best_hit = hit;
  });

  PanoramaSum sum;
  if (with_motion) {
    // From here on, the terms hold the derivatives by themselves.
    for_each_hit([&](std::size_t hit, const VoxelTally& tally) {
      terms.rays[hit] = tally.rays < 1.0 ? tally.best_gain : 0.0;
      terms.gain[hit] = hit == tally.best_hit ? std::min(1.0, tally.rays) : 0.0;
    });
    sum = kernel.motion(model, view, layer.blocks(), ids, terms);
  }
  for (const VoxelTally& tally : tallies) {
    sum.gain += std::min(1.0, tally.rays) * tally.best_gain;  // Equation (13), over voxels
  }
  return sum;
}

}  // namespace nbvopt::detail
