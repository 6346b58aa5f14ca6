#include "map/map_points.hpp"

#include <cstdint>

#include "map/append_number.hpp"
#include "map/map_access.hpp"
#include "map/surface_voxels.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/colour_ramp.hpp"

namespace nbvopt {
namespace {

using Node = UncertaintyOcTreeNode;

constexpr std::size_t kPointBytes = 16;  // at most

/// Calls visit(voxel, its leaf) for each voxel to be written, until it returns false.
template <class Visit>
void for_each_voxel(const UncertaintyOcTree& tree, MapPoints points, const Visit& visit) {
  if (points == MapPoints::surface) return for_each_surface_voxel(tree, visit);
  bool goes_on = true;
  for_each_leaf(tree, [&](const Node& leaf, VoxelKey origin, int depth) {
    if (!tree.isNodeOccupied(&leaf)) return;
    const int size = 1 << (UncertaintyOcTree::kDepth - depth);
    for (int z = origin.z; goes_on && z < origin.z + size; ++z) {
      for (int y = origin.y; goes_on && y < origin.y + size; ++y) {
        for (int x = origin.x; goes_on && x < origin.x + size; ++x) {
          goes_on = visit(VoxelKey{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                   static_cast<std::uint16_t>(z)},
                          leaf);
        }
      }
    }
  });
}

std::uint64_t count_points(const UncertaintyOcTree& tree, MapPoints points) {
  std::uint64_t count = 0;
  for_each_voxel(tree, points, [&](VoxelKey, const Node&) { return ++count <= kMostMapPoints; });
  if (count <= kMostMapPoints) return count;
  throw InputError(
      "the map has more than " + std::to_string(kMostMapPoints) +
      (points == MapPoints::surface ? " voxels on surfaces" : " occupied voxels") +
      ", too many for points: write a .bt or a .ot, which hold big blocks as one node" +
      (points == MapPoints::surface ? "" : ", or the surfaces alone"));
}

/// The header, then each point: its centre, then what append_colour() makes of its colour.
template <class AppendColour>
std::string point_file(const UncertaintyMap& map, MapPoints points, std::uint64_t count,
                       std::string bytes, const AppendColour& append_colour) {
  bytes.reserve(bytes.size() + kPointBytes * count);
  for_each_voxel(detail::MapAccess::tree(map), points, [&](VoxelKey key, const Node& leaf) {
    const Eigen::Vector3f centre_m = map.lattice().centre_m(key).cast<float>();
    for (const float coordinate_m : centre_m) append(bytes, coordinate_m);
    append_colour(bytes, uncertainty_colour(leaf.uncertainty()));
    return true;
  });
  return bytes;
}

}  // namespace

std::string ply_file(const UncertaintyMap& map, MapPoints points) {
  const std::uint64_t count = count_points(detail::MapAccess::tree(map), points);
  return point_file(
      map, points, count,
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
          "\nproperty float x\nproperty float y\nproperty float z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      [](std::string& bytes, const Colour& colour) { append(bytes, colour); });
}

std::string pcd_file(const UncertaintyMap& map, MapPoints points) {
  const std::uint64_t count = count_points(detail::MapAccess::tree(map), points);
  const std::string text = std::to_string(count);
  // PCL's convention: the colour is the bits of a float.
  return point_file(map, points, count,
                    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\n"
                    "SIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " +
                        text + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + text +
                        "\nDATA binary\n",
                    [](std::string& bytes, const Colour& colour) {
                      append(bytes, std::uint32_t{colour[0]} << 16 | std::uint32_t{colour[1]} << 8 |
                                        std::uint32_t{colour[2]});
                    });
}

}  // namespace nbvopt
