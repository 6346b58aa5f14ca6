#include "map/scan_marking.hpp"

#include <span>
#include <vector>

#include "map/parts.hpp"
#include "map/ray_bundles.hpp"
#include "map/segment_walk.hpp"
#include "map/shaft.hpp"

namespace nbvopt {

namespace {

using Bundle = std::span<const RayRun>;

/// Rays of a bundle that are walked from end to end before the others: so many of its runs, and so
/// many of each. A bundle ends in 4 x 4 voxels, so that they are about a voxel apart there.
constexpr std::uint32_t kSamples = 4;

constexpr std::size_t kBundlesAPart = 16;

std::uint32_t sample_step(std::size_t count) {
  return static_cast<std::uint32_t>((count + kSamples - 1) / kSamples);
}

class BundleMarker {
 public:
  BundleMarker(const ScanRays& rays, MarkWindow& window) : rays_(rays), window_(window) {}

  void mark_samples(Bundle bundle) {
    const std::uint32_t run_step = sample_step(bundle.size());
    for (std::size_t run = run_step / 2; run < bundle.size(); run += run_step) {
      const std::uint32_t ray_step = sample_step(bundle[run].count);
      for (std::uint32_t i = ray_step / 2; i < bundle[run].count; i += ray_step) {
        window_.mark_passed(walk(bundle[run].first + i), kAllSlabs);
      }
    }
  }

  void mark_others(Bundle bundle) {
    if (are_all_samples(bundle)) return;
    Eigen::AlignedBox3d ends;
    for (const RayRun& run : bundle) ends.extend(run.ends);
    const Shaft shaft(rays_.origin, ends);
    bundle_slabs_.clear();
    window_.find_unmarked(shaft, kAllSlabs, bundle_slabs_);
    if (bundle_slabs_.empty()) return;
    for (const RayRun& run : bundle) mark_run(run, shaft.axis());
  }

 private:
  SegmentWalk walk(std::uint32_t ray) const { return {rays_.origin, rays_.ends[ray]}; }

  static bool are_all_samples(Bundle bundle) {
    return bundle.size() <= kSamples &&
           std::ranges::all_of(bundle, [](const RayRun& run) { return run.count <= kSamples; });
  }

  /// Marks what the run's rays pierce in bundle_slabs_, which are slabs of the axis.
  void mark_run(const RayRun& run, int axis) {
    const Shaft shaft(rays_.origin, run.ends);
    run_slabs_.clear();
    if (shaft.axis() == axis) {
      for (const SlabRange& slabs : bundle_slabs_) window_.find_unmarked(shaft, slabs, run_slabs_);
    } else {
      window_.find_unmarked(shaft, kAllSlabs, run_slabs_);
    }
    if (run_slabs_.empty()) return;
    for (std::uint32_t ray = run.first; ray < run.first + run.count; ++ray) {
      const SegmentWalk segment = walk(ray);
      if (segment.axis() != shaft.axis()) {
        window_.mark_passed(segment, kAllSlabs);
        continue;
      }
      for (const SlabRange& slabs : run_slabs_) window_.mark_passed(segment, slabs);
    }
  }

  const ScanRays& rays_;
  MarkWindow& window_;
  std::vector<SlabRange> bundle_slabs_;  ///< in which not all is marked
  std::vector<SlabRange> run_slabs_;
};

}  // namespace

void mark_rays(const ScanRays& rays, const CancelToken& cancel, MarkWindow& window) {
  const RayBundles bundles(rays.ends.runs());
  const auto for_each_bundle = [&](void (BundleMarker::*mark)(Bundle)) {
    for_each_part(bundles.size(), kBundlesAPart, [&](std::size_t first, std::size_t last) {
      BundleMarker marker(rays, window);
      for (std::size_t i = first; i < last && !cancel.is_cancelled(); ++i) {
        (marker.*mark)(bundles[i]);
      }
    });
  };
  for_each_bundle(&BundleMarker::mark_samples);
  for_each_bundle(&BundleMarker::mark_others);
}

}  // namespace nbvopt
