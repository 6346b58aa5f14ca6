// A map's file, kept in pieces, so that a map of which little has changed is copied in little time.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/shared_bytes.hpp"
#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// Copies of an octree's branches, one a cube of 64 x 64 x 64 voxels (a tile, named by its least
/// key). Whoever writes the map says where; the copies there are made anew. Reads the map in the
/// functions that take it only. Not thread-safe, but for what it has given away.
class MapImage {
 public:
  /// The copies are counted among those that anybody holds.
  explicit MapImage(const HeldBytes& held) : held_(held) {}

  /// These tiles have changed.
  void forget(std::span<const VoxelKey> tiles);
  /// The whole map has.
  void forget_all();

  /// The tiles of which there is no copy.
  std::vector<VoxelKey> missing(const UncertaintyMap& map) const;

  /// Copies a tile, if it is in the map.
  void copy(const UncertaintyMap& map, VoxelKey tile);

  /// The bytes of map_file_bytes(), MapFormat::uncertainty_ot. Copies what is missing.
  SharedBytes file(const UncertaintyMap& map);

  /// What the copies take that are not forgotten.
  std::uint64_t bytes() const { return bytes_; }

 private:
  const HeldBytes held_;
  std::unordered_map<std::uint64_t, SharedBytes::Piece> pieces_;  ///< by the tile's packed key
  std::uint64_t bytes_ = 0;                                       ///< of the pieces
};

}  // namespace nbvopt
