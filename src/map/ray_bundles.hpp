// The rays of a scan, gathered by where they end.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace nbvopt {

/// Rays that follow one another in the scan and end in one block of voxels or a voxel beside it,
/// lest noise at the border of two blocks makes a run of every ray: of a depth image, a part of a
/// row.
struct RayRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Eigen::AlignedBox3d ends;  ///< in lattice coordinates
};

/// Runs whose first rays end in the same block of 4 x 4 x 4 voxels, in the order of the scan.
class RayBundles {
 public:
  /// Ends in lattice coordinates.
  explicit RayBundles(std::span<const Eigen::Vector3d> ends);

  std::size_t size() const { return starts_.size() - 1; }
  std::span<const RayRun> operator[](std::size_t bundle) const {
    return std::span(runs_).subspan(starts_[bundle], starts_[bundle + 1] - starts_[bundle]);
  }

 private:
  std::vector<RayRun> runs_;
  std::vector<std::uint32_t> starts_;  ///< of each bundle in runs_, and where the last one ends
};

}  // namespace nbvopt
