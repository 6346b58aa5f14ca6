#include "gain/voxel_sum.hpp"

#include <algorithm>
#include <vector>

namespace nbvopt::detail {
namespace {

/// What is known of a voxel while its hits go by.
struct VoxelTally {
  std::uint64_t sum_number = 0;  ///< of the sum that the rest belongs to
  double rays = 0.0;
  double best_gain = 0.0;
  std::size_t best_hit = 0;
};

}  // namespace

PanoramaSum voxel_sum(const PanoramaKernel& kernel, const PanoramaModel& model,
                      const PanoramaView& view, const PanoramaLayer& layer,
                      std::span<const std::uint32_t> blocks, bool with_motion) {
  thread_local HitTerms terms;
  // Kept from sum to sum, since most of a layer's voxels are out of view.
  thread_local std::vector<VoxelTally> tallies;
  thread_local std::uint64_t sum_number = 0;
  ++sum_number;
  kernel.terms(model, view, layer.blocks(), blocks, terms);

  const auto for_each_hit = [&](const auto& visit) {
    std::size_t hit = 0;
    for (const std::uint32_t block : blocks) {
      for (const std::uint32_t voxel : layer.voxels(block)) visit(hit++, voxel);
    }
  };
  for_each_hit([&](std::size_t hit, std::uint32_t voxel) {
    if (terms.rays[hit] <= 0.0) return;
    if (voxel >= tallies.size()) tallies.resize(2 * std::size_t{voxel} + 1);
    VoxelTally& tally = tallies[voxel];
    if (tally.sum_number != sum_number) tally = {.sum_number = sum_number};
    tally.rays += terms.rays[hit];
    if (terms.gain[hit] <= tally.best_gain) return;
    tally.best_gain = terms.gain[hit];
    tally.best_hit = hit;
  });

  // In the order of the hits, whatever the voxels' numbers are. From here on, the terms hold the
  // derivatives by themselves.
  PanoramaSum sum;
  double gain = 0.0;
  for_each_hit([&](std::size_t hit, std::uint32_t voxel) {
    if (terms.rays[hit] <= 0.0) {
      terms.gain[hit] = 0.0;
      return;
    }
    const VoxelTally& tally = tallies[voxel];
    const bool is_best = tally.best_gain > 0.0 && hit == tally.best_hit;
    if (is_best) gain += std::min(1.0, tally.rays) * tally.best_gain;  // Equation (13)
    terms.rays[hit] = tally.rays < 1.0 ? tally.best_gain : 0.0;
    terms.gain[hit] = is_best ? std::min(1.0, tally.rays) : 0.0;
  });
  if (with_motion) sum = kernel.motion(model, view, layer.blocks(), blocks, terms);
  sum.gain = gain;
  return sum;
}

}  // namespace nbvopt::detail
