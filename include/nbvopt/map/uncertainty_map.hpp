// The map that is kept and saved: an octree of occupancy, colour and uncertainty.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

class UncertaintyOcTree;  // src/map/uncertainty_octree.hpp: OctoMap stays out of public headers

namespace detail {
struct MapAccess;
}

/// What is known of one voxel.
struct VoxelRecord {
  VoxelState state = VoxelState::unknown;
  float log_odds = 0.0F;                    ///< of being occupied; 0 when unknown
  float uncertainty = kUnknownUncertainty;  ///< Eq. 9, in [0, 1]; 1 unless occupied
  std::array<std::uint8_t, 3> colour{255, 255, 255};
};

/// Counts over leaves at the finest resolution: a pruned leaf counts as the voxels it covers.
struct MapCounts {
  std::uint64_t occupied_voxels = 0;
  std::uint64_t free_voxels = 0;
  std::uint64_t certain_voxels = 0;  ///< occupied with u < 1: the "voxels" of the paper's Table 1
  double information = 0.0;          ///< Eq. 11, sum of 1 - u over occupied voxels
  std::uint64_t leaves = 0;
  std::uint64_t nodes = 0;  ///< leaves and inner nodes
};

/// Counts as the paper's released services give them: over all nodes of the tree with u < 1, inner
/// ones included, a pruned leaf once. They depend on the shape of the tree; for comparison only.
struct PaperCounts {
  std::uint64_t voxels = 0;
  double information = 0.0;  ///< sum of 1 - u
};

/// An octree over OctoMap's lattice. Its invariants: a leaf is pruned only where occupancy, colour
/// and uncertainty of all that it covers are equal; an inner node holds its children's maximum
/// occupancy and maximum u. One thread writes at a time; reading is safe while nobody writes.
class UncertaintyMap {
 public:
  /// An empty map. Throws InputError unless the resolution is positive and finite.
  explicit UncertaintyMap(double resolution_m);
  /// `is_plain` says that no voxel of the tree carries uncertainty, as in plain OctoMaps; it spares
  /// looking.
  explicit UncertaintyMap(std::unique_ptr<UncertaintyOcTree> tree, bool is_plain = false);
  UncertaintyMap(UncertaintyMap&&) noexcept;
  UncertaintyMap& operator=(UncertaintyMap&&) noexcept;
  ~UncertaintyMap();

  const Lattice& lattice() const { return lattice_; }
  double resolution_m() const { return lattice_.resolution_m(); }

  VoxelRecord at(VoxelKey key) const;

  /// Writes one voxel, whatever it was. `log_odds` decides the state: >= 0 is occupied, as in
  /// OctoMap. u is kept for occupied voxels only. Call finish_writing() after the last one.
  /// Throws UsageError unless log-odds are finite and u is in [0, 1].
  void set(VoxelKey key, const VoxelRecord& record);

  /// Restores the invariants of inner nodes and prunes, after writes by set().
  void finish_writing();

  MapCounts counts() const;
  PaperCounts paper_counts() const;

  /// The smallest box that holds every known voxel; none when the map is empty.
  std::optional<KeyBox> known_box() const;

  /// How many bricks of 32 x 32 x 32 voxels hold anything known: what a whole VoxelGrid takes.
  std::uint64_t known_bricks() const;

  /// What the tree takes, bytes, to a tenth or so; takes no time.
  std::uint64_t memory_bytes() const;

  /// Whether any occupied voxel carries u < 1. Plain OctoMaps carry none.
  bool carries_uncertainty() const;

  /// Whether any voxel is occupied; takes no time.
  bool has_occupied() const;

 private:
  friend struct detail::MapAccess;

  std::unique_ptr<UncertaintyOcTree> tree_;
  Lattice lattice_;
  bool is_plain_;  ///< known to carry no uncertainty
};

}  // namespace nbvopt
