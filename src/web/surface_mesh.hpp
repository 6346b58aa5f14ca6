// The surfaces of a map as few rectangles: what a viewer draws instead of voxels.
//
// A face lies between a voxel and a neighbour of another state. Neighbouring faces of one plane and
// kind are merged into rectangles (greedy meshing), whatever their uncertainty: each face keeps a
// value of its own, so that merging loses no colour.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "map/brick_table.hpp"
#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// The direction in which a face looks.
enum class FaceNormal : std::uint8_t { minus_x, plus_x, minus_y, plus_y, minus_z, plus_z };

/// The axis across a face: 0 for x, 1 for y, 2 for z.
constexpr int axis_of(FaceNormal normal) { return static_cast<int>(normal) / 2; }

/// A rectangle of faces of one plane. Its width runs along the axis after the normal's (y after x,
/// z after y, x after z), its height along the one after that.
struct FaceRectangle {
  static constexpr int kLongest = 32;

  VoxelKey least;  ///< the voxel of its first face
  FaceNormal normal = FaceNormal::minus_x;
  std::uint8_t width = 1;   ///< faces, at most kLongest
  std::uint8_t height = 1;  ///< faces, at most kLongest

  bool operator==(const FaceRectangle&) const = default;
};

/// Calls visit(voxel) for each face of a rectangle, row after row along the width.
template <typename Visit>
void for_each_face(const FaceRectangle& rectangle, const Visit& visit) {
  const int axis = axis_of(rectangle.normal);
  for (int v = 0; v < rectangle.height; ++v) {
    for (int u = 0; u < rectangle.width; ++u) {
      std::array<int, 3> key{rectangle.least.x, rectangle.least.y, rectangle.least.z};
      key[(axis + 1) % 3] += u;
      key[(axis + 2) % 3] += v;
      visit(VoxelKey{static_cast<std::uint16_t>(key[0]), static_cast<std::uint16_t>(key[1]),
                     static_cast<std::uint16_t>(key[2])});
    }
  }
}

/// Rectangles, and of each of their faces a value in the order of for_each_face().
struct FaceSet {
  std::vector<FaceRectangle> rectangles;
  /// u of the face's voxel in 255 steps, rounded down, so that 255 is 1 alone; none in a frontier.
  std::vector<std::uint8_t> values;
  std::uint64_t faces = 0;
};

struct SurfaceMesh {
  FaceSet seen;      ///< faces of occupied voxels that look into free ones
  FaceSet backs;     ///< faces of occupied voxels that look into unknown ones
  FaceSet frontier;  ///< faces of free voxels that look into unknown ones
};

/// More faces are not drawn: as many texels as a picture of 4096 x 4096 has.
inline constexpr std::uint64_t kMostFaces = std::uint64_t{1} << 24;

/// More of the map's space is not gone through: 64 x 64 x 64 bricks of 32 x 32 x 32 voxels.
inline constexpr std::uint64_t kMostBricks = std::uint64_t{1} << 18;

/// The faces of the voxels in `box` (none: of all), whatever lies beside them outside. Occupied
/// voxels without stored uncertainty have u = 1. Throws InputError beyond kMostFaces of a set, and
/// where more than kMostBricks in the box are known.
SurfaceMesh surface_mesh(const UncertaintyMap& map, const std::optional<KeyBox>& box = {});

/// The same of the voxels of one brick of a whole grid, such as a server publishes.
SurfaceMesh brick_surface(const detail::BrickTable& grid, detail::BrickKey brick);

/// Throws InputError: the map has more than `most` of some things.
[[noreturn]] void refuse_to_draw(std::uint64_t most, const char* things);

}  // namespace nbvopt
