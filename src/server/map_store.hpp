// The server's map: one tree that scans write, and immutable versions of it that plans read.
#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/shared_bytes.hpp"
#include "map/map_image.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "server/limits.hpp"

namespace nbvopt {

/// A map as the bytes of a file.
struct MapBytes {
  SharedBytes bytes;
  std::uint64_t version = 0;
  std::optional<HazardTable> hazards;  ///< learnt up to there, where the gain is expected
};

struct VersionedCounts {
  MapCounts counts;
  PaperCounts paper;
  std::uint64_t version = 0;
};

/// Safe to share between threads. Those who change or copy the tree wait for each other, a copy
/// letting the others pass every few milliseconds; nobody waits for them who reads what is
/// published.
class MapStore {
 public:
  /// Holds `map` as version `version`; what scans teach is added to `hazards`. Throws LimitError
  /// when it is too large.
  MapStore(const Robot& robot, const ServerLimits& limits, UncertaintyMap map,
           std::uint64_t version, const HazardTable& hazards = HazardTable());

  const Robot& robot() const { return robot_; }

  /// A planner on the newest version.
  std::shared_ptr<const ViewPlanner> published() const;

  struct Insertion {
    InsertResult result;
    std::uint64_t version = 0;  ///< the first that holds the scan
  };
  /// Inserts a scan and publishes the map with it. Throws as insert_scan() does, and LimitError
  /// when the map is full or the scan would stretch it too far or take too much memory; the map is
  /// then untouched.
  Insertion insert(const Scan& scan, const Transform& T_map_sensor,
                   const CancelToken& cancel = CancelToken());

  /// Publishes another map in place of this one and returns its version. Throws LimitError when it
  /// is too large; the map is then as it was.
  std::uint64_t replace(UncertaintyMap map);

  /// Publishes an empty map of this resolution, or of the same as before, and returns its version.
  /// Throws as UncertaintyMap does.
  std::uint64_t clear(std::optional<double> resolution_m);

  /// Makes what is known in the box free and publishes the map; returns its version. Throws
  /// InputError as nbvopt::clear_box() does; the map is then untouched.
  std::uint64_t clear_box(const KeyBox& box);

  /// A version as a file, the newest or one published since this was called. Copied from the tree
  /// bit by bit, so that scans wait for milliseconds; what versions have in common is shared.
  std::shared_ptr<const MapBytes> bytes(MapFormat format) const;

  /// What readers hold of copies that the map has left behind, bytes.
  std::uint64_t pinned_bytes() const;

  /// What the newest version takes, tree and bricks, bytes.
  std::uint64_t map_bytes() const { return map_bytes_; }
  /// What copies for snapshots and readers take, bytes.
  std::uint64_t copy_bytes() const { return held_.bytes(); }

  /// Counts, kept until the map changes.
  VersionedCounts counts() const;

 private:
  /// Throws LimitError, naming the limit, unless a map with this box is small enough.
  void check_extent(const Eigen::AlignedBox3d& box_m) const;
  /// The same for a whole map and all limits; returns its box in the map frame.
  Eigen::AlignedBox3d checked_extent_m(const UncertaintyMap& map) const;
  /// The same for what a map takes.
  void check_size(std::uint64_t bytes) const;
  std::uint64_t max_bytes() const;
  /// Which limit it is that a map or a scan goes beyond.
  std::string limit_text() const;
  /// The newest version as an .ot with everything in it.
  MapBytes copy() const;
  /// `tree_bytes` is what the grid's tree takes.
  void publish(std::shared_ptr<const VoxelGrid> grid, std::uint64_t tree_bytes);
  /// Publishes the tree as it is, whatever the grid holds.
  void publish_whole() {
    publish(VoxelGrid::whole(map_, grid_->version() + 1), map_.memory_bytes());
  }

  const Robot robot_;
  const ServerLimits limits_;
  const HeldBytes held_;  ///< of what bytes() gives away
  std::atomic<std::uint64_t> map_bytes_{0};

  mutable std::mutex tree_mutex_;  ///< of what follows
  UncertaintyMap map_;
  Eigen::AlignedBox3d extent_m_;  ///< of what is known, with the reach of all scans
  std::shared_ptr<const VoxelGrid> grid_;
  HazardTable hazards_;          ///< learnt from the scans, where the robot's gain is expected
  bool is_grid_behind_ = false;  ///< an insertion failed half way, out of memory, say
  mutable VersionedCounts counts_;
  mutable MapImage image_{held_};

  mutable std::mutex bytes_mutex_;  ///< of what follows; taken before that of the tree
  mutable std::map<MapFormat, std::weak_ptr<const MapBytes>> bytes_;

  mutable std::mutex published_mutex_;  ///< held for the copy of one pointer
  std::shared_ptr<const ViewPlanner> published_;
};

}  // namespace nbvopt
