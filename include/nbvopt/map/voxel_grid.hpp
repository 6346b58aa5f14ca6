// The cast-ready form of a map: bricks of voxels on OctoMap's key lattice.
//
// A published grid is immutable and has a version: a scan makes a new grid that shares all the
// bricks that the scan did not touch. "Lazily filled" changes no answer: a brick is read from
// the map the first time that a box which it touches is asked for.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

namespace detail {
class BrickTable;
struct MapAccess;
}  // namespace detail

/// All that lies within a distance of a box.
struct Surroundings {
  Eigen::AlignedBox3d box_map_m;
  double radius_m = 0.0;

  double distance_m(const Eigen::Vector3d& p_map_m) const {
    return box_map_m.exteriorDistance(p_map_m);
  }
};

class VoxelGrid {
 public:
  /// A grid that reads its bricks when they are first needed. The map must outlive the grid and
  /// every grid made from it, and must not change: for a saved map.
  static std::shared_ptr<const VoxelGrid> lazy(const UncertaintyMap& map);

  /// A grid with all its bricks read now; the map may change or go afterwards: for a growing map.
  static std::shared_ptr<const VoxelGrid> whole(const UncertaintyMap& map,
                                                std::uint64_t version = 1);

  /// The next version: this grid with the changes that a scan made. Bricks without a change, and
  /// away from any change of state, are shared. Throws UsageError on a lazy grid.
  std::shared_ptr<const VoxelGrid> updated(std::span<const VoxelChange> changes) const;

  /// 1 for a grid made from a map unless said otherwise, one more a call to updated().
  std::uint64_t version() const { return version_; }

  const Lattice& lattice() const { return lattice_; }

  /// Whether the map carried any uncertainty; if not, occupied voxels count with the u that
  /// SensorOptions::occupied_uncertainty gives.
  bool carries_uncertainty() const { return carries_uncertainty_; }

  /// Whether the map had any occupied voxel, or a scan has made one since.
  bool has_occupied() const { return has_occupied_; }

  /// Makes every brick that touches the box ready. Thread-safe; cheap when they are. Voxels may be
  /// looked up only where they were made ready.
  void make_ready(const KeyBox& box) const;
  /// The same for every brick that touches the surroundings of a box.
  void make_ready(const Surroundings& near) const;

  /// Makes every brick ready and lets go of the map, which may then change or go: the grid is as
  /// whole() makes it. Thread-safe.
  void read_all() const;

  VoxelState state(VoxelKey key) const;

  /// u of an occupied voxel; 1 of any other.
  float uncertainty(VoxelKey key) const;

  /// Whether the box holds an occupied voxel.
  bool any_occupied(const KeyBox& box) const;

  /// Whether anything is known in a brick that touches the surroundings of a box.
  bool any_known(const Surroundings& near) const;

  /// What the bricks take, bytes; bricks shared with other versions included.
  std::size_t memory_bytes() const;

  ~VoxelGrid();

 private:
  friend struct detail::MapAccess;

  static std::shared_ptr<VoxelGrid> of(const UncertaintyMap& map, std::uint64_t version);

  VoxelGrid(const Lattice& lattice, std::unique_ptr<detail::BrickTable> table,
            std::uint64_t version);

  Lattice lattice_;
  std::unique_ptr<detail::BrickTable> table_;
  std::uint64_t version_;
  bool carries_uncertainty_ = false;
  bool has_occupied_ = false;
};

}  // namespace nbvopt
