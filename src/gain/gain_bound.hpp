// An upper bound on the exact gain of all views from boxes of joint positions.
//
// Rays go through the same pixels whatever the joints do, so the angle's part of u_new is a
// constant of the ray. What else a ray brings is at most the largest u_old - weight * u_d that any
// ray in a range of directions, from anywhere that the box has the camera, can meet: a maximum over
// cells of directions (ConeCells), each of which a cone is marched for. The sum over rays bounds
// the gain per ray, and per voxel too, where each voxel counts once. An expected gain is a mean
// over hits that a ray may have in the unknown, and so no larger than the best of them.
//
// Panning turns directions by a constant, so boxes are bins of pan and tilt as wide as cells, and
// the bounds of a row of bins are sums of rows of cells that lie side by side.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gain/cone_cells.hpp"
#include "gain/cone_grid.hpp"
#include "gain/cone_march.hpp"
#include "gain/ray_ranges.hpp"
#include "nbvopt/core/stop.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt::detail {

/// Bins of pan and tilt in a slab of heights, and a bound for each bin. Bins are half as wide from
/// level to level, slabs half as high.
struct BoundBlock {
  int level = 0;
  std::array<int, 3> first{};  ///< by joint, counted from the box's least corner
  int pans = 0, tilts = 0;     ///< bins
  /// The bins that have a bound, counted from the block's first: no others need a look.
  int pan_begin = 0, pan_end = 0, tilt_begin = 0, tilt_end = 0;
  /// No view of a bin gains more; bins of pan lie side by side.
  std::vector<float> bounds;
  std::shared_ptr<const ConeCells> coarser;  ///< the cells of its parent

  /// Of a row's bin pan_begin.
  float* row(int tilt) {
    return &bounds[static_cast<std::size_t>((tilt - tilt_begin) * (pan_end - pan_begin))];
  }
  const float* row(int tilt) const { return const_cast<BoundBlock*>(this)->row(tilt); }
  float largest() const;
};

/// Makes and tightens blocks. Not thread-safe: cells are filled when a block first needs them, and
/// kept, so that to bound the same bins again costs little.
class GainBound {
 public:
  /// The grid must outlive it. The sensor's gain must be positive or expected. Throws InputError
  /// where the reach of the camera is absurdly large.
  GainBound(const VoxelGrid& grid, const SensorOptions& sensor, const MovingMast& mast,
            const JointBox& box);

  /// The blocks of level 0, which together hold the whole box.
  std::vector<BoundBlock> roots() const;

  /// The blocks of the next level that together hold those of this one's bins that are above
  /// `worth`, each with its parent's bound; none where joints are told apart no further.
  std::vector<BoundBlock> children(const BoundBlock& block, float worth) const;

  /// Lowers the bounds of those bins that are above `worth`. Returns false where it had to stop, or
  /// where its cells would take more than 256 MiB, the bounds then being valid, if not as low.
  /// Evaluations, of which `stop` may allow so many, are cones, of all calls together.
  bool tighten(BoundBlock& block, float worth, const StopRule& stop);

  /// The joint positions of a bin, which may stick out of the box.
  JointBox box_of(const BoundBlock& block, int pan, int tilt) const;

  std::int64_t cones() const { return cones_; }

 private:
  struct Alive;
  using BlockKey = std::array<int, 4>;  ///< level, and the block's first bins

  double cell_rad(int level) const;
  double slab_m(int level) const;
  int bins(int joint, int level) const;
  std::vector<BoundBlock> cut(int level, const std::array<int, 3>& first,
                              const std::array<int, 3>& end) const;
  JointBox box_of(const BoundBlock& block) const;
  /// The cells of a block, empty where they are new.
  ConeCells& cells_of(const BoundBlock& block, const std::pair<double, double>& turn_cells);
  /// The cells that rays of the views of some bins of a row go through.
  CellBox seen_from(const BoundBlock& block, int tilt, int begin, int end,
                    const std::pair<double, double>& turn_cells);
  const RayRanges& ranges_of(int level, int tilt);
  /// When the mast can have arrived anywhere in the box.
  std::pair<double, double> arrival_times_s(const JointBox& box) const;
  /// By how much the base has turned by then.
  std::pair<double, double> turns_rad(const JointBox& box) const;
  /// Where the camera can be.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> origins_m(const JointBox& box) const;

  Lattice lattice_;
  DepthCamera camera_;
  MovingMast mast_;
  JointBox box_;
  int block_bins_;  ///< along pan and tilt, at most: the camera moves little within them
  std::vector<float> angle_part_;
  ConeGrid cones_grid_;
  ConeMarch march_;
  std::map<std::pair<int, int>, RayRanges> ranges_;  ///< by level and tilt
  std::map<BlockKey, std::shared_ptr<ConeCells>> cells_;
  std::int64_t cones_ = 0;
  std::size_t cell_bytes_ = 0;
};

}  // namespace nbvopt::detail
