// The surface of a growing map, brick by brick, for pages that follow it: of each version only what
// changed is made and sent.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/shared_bytes.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt {

/// Holds the surface of the newest grid alone: a reader names the version that it has, and no
/// reader is remembered.
class GrowingSurface {
 public:
  /// Makes the surfaces of those bricks that differ from the grid shown before. The grid is whole,
  /// its version greater than that of the one before. The grid is kept for the next comparison.
  void show(std::shared_ptr<const VoxelGrid> grid);

  /// Lets go of the grid. The next one has all its surfaces made; those that are as before are not
  /// sent again.
  void forget_grid() { grid_ = nullptr; }

  /// Of the grid that was shown last; 0 before.
  std::uint64_t version() const { return version_; }

  /// Of the whole map; without leaves and nodes.
  MapCounts counts() const;

  /// Whether all that changed since that version is known; if not, a reader needs all.
  bool knows(std::uint64_t version) const { return version >= first_ && version <= version_; }

  /// The bricks that changed since a version that it knows, or all: members of a JSON object, named
  /// "x,y,z" by the brick's first voxel, with what packed_surface() makes of the brick's surface;
  /// empty where none is left. Throws InputError where the map has more than kMostFaces of a set.
  SharedBytes members(std::optional<std::uint64_t> since) const;

 private:
  using Place = std::array<int, 3>;  ///< of a brick, in bricks

  struct Brick {
    std::uint64_t version = 0;  ///< the first with this text
    SharedBytes::Piece member;  ///< null: it has no faces, and never had
    std::array<std::uint64_t, 3> faces{};
    MapCounts counts;

    bool is_gone() const { return member != nullptr && faces == decltype(faces){}; }
  };

  void remake(const VoxelGrid& grid, const Place& place);
  void forget_gone();

  std::shared_ptr<const VoxelGrid> grid_;
  std::map<Place, Brick> bricks_;
  double resolution_m_ = 0.0;
  std::uint64_t version_ = 0;
  std::uint64_t first_ = 0;
};

}  // namespace nbvopt
