// Where the rays of a scan end.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

/// Rays that follow one another in the scan and end in one block of voxels or a voxel beside it,
/// lest noise at the border of two blocks makes a run of every ray: of a depth image, a part of a
/// row.
struct RayRun {
  std::uint64_t block = 0;  ///< that of its first ray
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Eigen::AlignedBox3d ends;
};

/// The ends of rays in the order of the scan, and their runs. Coordinates are those of the lattice.
class RayEnds {
 public:
  void reserve(std::size_t rays) { ends_.reserve(rays); }

  void add(const Eigen::Vector3d& end) {
    const Eigen::Vector3i voxel = end.cast<int>();
    if (runs_.empty() || !is_near_block(voxel)) begin_run(voxel);
    ++runs_.back().count;
    runs_.back().ends.extend(end);
    ends_.push_back(end);
  }

  std::size_t size() const { return ends_.size(); }
  const Eigen::Vector3d& operator[](std::size_t ray) const { return ends_[ray]; }
  std::span<const RayRun> runs() const { return runs_; }

  /// The smallest box that holds them.
  Eigen::AlignedBox3d box() const {
    Eigen::AlignedBox3d box;
    for (const RayRun& run : runs_) box.extend(run.ends);
    return box;
  }

 private:
  static constexpr int kBlockBits = 2;
  static constexpr int kBlockSize = 1 << kBlockBits;  ///< voxels

  /// Whether a voxel lies in the last run's block or beside it.
  bool is_near_block(const Eigen::Vector3i& voxel) const {
    const Eigen::Array3i inside = (voxel - least_of_block_).array();
    return (inside >= -1).all() && (inside <= kBlockSize).all();
  }

  void begin_run(const Eigen::Vector3i& voxel) {
    const auto block = [&](int axis) {
      return static_cast<std::uint16_t>(voxel[axis] >> kBlockBits);
    };
    const VoxelKey place{block(0), block(1), block(2)};
    least_of_block_ = Eigen::Vector3i(place.x, place.y, place.z) * kBlockSize;
    runs_.push_back({packed(place), static_cast<std::uint32_t>(ends_.size()), 0, {}});
  }

  std::vector<Eigen::Vector3d> ends_;
  std::vector<RayRun> runs_;
  Eigen::Vector3i least_of_block_ = Eigen::Vector3i::Zero();  ///< of the last run
};

}  // namespace nbvopt
