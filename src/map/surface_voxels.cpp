#include "map/surface_voxels.hpp"

#include <array>

namespace nbvopt {
namespace {

using Node = UncertaintyOcTreeNode;

constexpr int kLatticeSize = 1 << UncertaintyOcTree::kDepth;

/// A voxel that may lie off the lattice.
using Cell = std::array<int, 3>;

VoxelKey key_of(const Cell& cell) {
  return {static_cast<std::uint16_t>(cell[0]), static_cast<std::uint16_t>(cell[1]),
          static_cast<std::uint16_t>(cell[2])};
}

/// Which way a face looks.
struct Side {
  std::size_t axis;
  int step;  ///< 1 or -1
};
constexpr std::array<Side, 6> kSides{{{0, -1}, {0, 1}, {1, -1}, {1, 1}, {2, -1}, {2, 1}}};

/// Searches leaves by their faces. Visits stop at the first that says so.
class SurfaceSearch {
 public:
  using Visit = std::function<bool(VoxelKey, const Node&)>;

  SurfaceSearch(const UncertaintyOcTree& tree, const Visit& visit) : tree_(tree), visit_(visit) {}

  /// Visits the surface under a node. Whether to go on.
  bool search(const Node& node, VoxelKey origin, int depth) {
    if (!tree_.isNodeOccupied(&node)) return true;  // nor is anything under it
    if (tree_.nodeHasChildren(&node)) {
      for (int i = 0; i < 8; ++i) {
        if (tree_.nodeChildExists(&node, i) &&
            !search(*tree_.getNodeChild(&node, i), child_origin(origin, i, depth), depth + 1)) {
          return false;
        }
      }
      return true;
    }
    leaf_ = &node;
    least_ = {origin.x, origin.y, origin.z};
    size_ = 1 << (UncertaintyOcTree::kDepth - depth);
    for (std::size_t side = 0; side < kSides.size(); ++side) {
      if (!search_face(side, least_, size_)) return false;
    }
    return true;
  }

 private:
  bool is_occupied(const Cell& cell) const {
    for (const int c : cell) {
      if (c < 0 || c >= kLatticeSize) return false;
    }
    const Node* node = tree_.search(octomap_key(key_of(cell)));
    return node != nullptr && tree_.isNodeOccupied(node);
  }

  Cell beside(Cell cell, std::size_t side) const {
    cell[kSides[side].axis] += kSides[side].step;
    return cell;
  }

  /// Visits what is free of a square part of a face of the leaf, the cube from `least` on.
  bool search_face(std::size_t side, const Cell& least, int size) {
    const auto [axis, step] = kSides[side];
    if (size == 1) {
      Cell cell = least;
      return is_occupied(beside(cell, side)) || visit_once(side, cell);
    }
    // The cube beside it, as big, is a node of the tree if there is one.
    Cell neighbour = least;
    neighbour[axis] += step * size;
    const bool is_on_lattice = neighbour[axis] >= 0 && neighbour[axis] < kLatticeSize;
    const Node* node = is_on_lattice ? node_at(neighbour, size) : nullptr;
    if (node != nullptr && !tree_.isNodeOccupied(node)) node = nullptr;
    if (node != nullptr && !tree_.nodeHasChildren(node)) return true;
    if (node == nullptr) return visit_face(side, least, size);
    const int half = size / 2;
    for (int quarter = 0; quarter < 4; ++quarter) {
      Cell part = least;
      part[(axis + 1) % 3] += quarter & 1 ? half : 0;
      part[(axis + 2) % 3] += quarter & 2 ? half : 0;
      if (step > 0) part[axis] += half;
      if (!search_face(side, part, half)) return false;
    }
    return true;
  }

  /// The node that covers exactly that cube, or the leaf that covers it; null where all is unknown.
  const Node* node_at(const Cell& least, int size) const {
    int depth = UncertaintyOcTree::kDepth;
    for (int covered = 1; covered < size; covered *= 2) --depth;
    return tree_.search(octomap_key(key_of(least)), static_cast<unsigned>(depth));
  }

  /// Visits the voxels of a part of a face that all lie free.
  bool visit_face(std::size_t side, const Cell& least, int size) {
    const auto [axis, step] = kSides[side];
    Cell cell = least;
    if (step > 0) cell[axis] += size - 1;
    for (int v = 0; v < size; ++v) {
      for (int u = 0; u < size; ++u) {
        cell[(axis + 1) % 3] = least[(axis + 1) % 3] + u;
        cell[(axis + 2) % 3] = least[(axis + 2) % 3] + v;
        if (!visit_once(side, cell)) return false;
      }
    }
    return true;
  }

  /// A voxel on an edge of the leaf lies on several faces: the first that is free counts.
  bool visit_once(std::size_t side, const Cell& cell) {
    for (std::size_t other = 0; other < side; ++other) {
      const auto [axis, step] = kSides[other];
      const int outermost = step > 0 ? least_[axis] + size_ - 1 : least_[axis];
      if (cell[axis] == outermost && !is_occupied(beside(cell, other))) return true;
    }
    return visit_(key_of(cell), *leaf_);
  }

  const UncertaintyOcTree& tree_;
  const Visit& visit_;
  const Node* leaf_ = nullptr;
  Cell least_{};  ///< of the leaf
  int size_ = 0;  ///< of the leaf
};

}  // namespace

void for_each_surface_voxel(const UncertaintyOcTree& tree,
                            const std::function<bool(VoxelKey, const Node&)>& visit) {
  if (tree.getRoot() != nullptr) SurfaceSearch(tree, visit).search(*tree.getRoot(), VoxelKey{}, 0);
}

}  // namespace nbvopt
