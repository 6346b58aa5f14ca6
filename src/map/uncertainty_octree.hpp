// The octree under UncertaintyMap: OctoMap's occupancy tree whose nodes carry colour and
// uncertainty too. Private: it is the only header besides the sources that shows OctoMap.
#pragma once

#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

using Colour = std::array<std::uint8_t, 3>;

/// OctoMap's "no colour".
inline constexpr Colour kNoColour{255, 255, 255};

/// Occupancy (log-odds), colour and uncertainty. The functions in camelCase hide OctoMap's, whose
/// templates call them by these names: equality decides what is pruned, copyData() what an
/// expanded leaf hands down.
class UncertaintyOcTreeNode : public octomap::OcTreeNode {
 public:
  bool operator==(const UncertaintyOcTreeNode& other) const {
    return value == other.value && colour_ == other.colour_ && uncertainty_ == other.uncertainty_;
  }

  void copyData(const UncertaintyOcTreeNode& from) {
    OcTreeNode::copyData(from);
    colour_ = from.colour_;
    uncertainty_ = from.uncertainty_;
  }

  /// Makes this inner node hold its children's maximum occupancy, maximum u and mean colour (of
  /// those that have one).
  void updateOccupancyChildren();

  /// Gives back the array of children, once all are deleted.
  void free_child_array() {
    delete[] children;
    children = nullptr;
  }

  const Colour& colour() const { return colour_; }
  void set_colour(const Colour& colour) { colour_ = colour; }
  float uncertainty() const { return uncertainty_; }
  void set_uncertainty(float uncertainty) { uncertainty_ = uncertainty; }

 private:
  Colour colour_ = kNoColour;
  float uncertainty_ = kUnknownUncertainty;
};

class UncertaintyOcTree : public octomap::OccupancyOcTreeBase<UncertaintyOcTreeNode> {
 public:
  using Node = UncertaintyOcTreeNode;
  static constexpr int kDepth = 16;

  explicit UncertaintyOcTree(double resolution_m) : OccupancyOcTreeBase(resolution_m) {}

  UncertaintyOcTree* create() const override { return new UncertaintyOcTree(resolution); }
  std::string getTreeType() const override { return "UncertaintyOcTree"; }

  /// The root, made when the tree is empty.
  Node& make_root();

  /// The leaf of one voxel at the finest resolution: made when unknown, split off when pruned.
  /// The inner nodes above are left as they were.
  Node& make_voxel(VoxelKey key);

  /// Makes the node a leaf, whatever is below it.
  void delete_children(Node& node);

  /// Restores and prunes a node whose children are in order.
  void update_inner_node(Node& node) {
    if (!pruneNode(&node)) node.updateOccupancyChildren();
  }
};

inline octomap::OcTreeKey octomap_key(VoxelKey key) { return {key.x, key.y, key.z}; }

/// The key of child `index` of a node at `depth` whose least key is `origin`; OctoMap's order.
inline VoxelKey child_origin(VoxelKey origin, int index, int depth) {
  const int half = 1 << (UncertaintyOcTree::kDepth - depth - 1);
  return {static_cast<std::uint16_t>(origin.x + (index & 1 ? half : 0)),
          static_cast<std::uint16_t>(origin.y + (index & 2 ? half : 0)),
          static_cast<std::uint16_t>(origin.z + (index & 4 ? half : 0))};
}

/// Calls visit(node, least key, depth) for the leaves under `node`, in OctoMap's order.
template <class Visit>
void for_each_leaf(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode& node,
                   VoxelKey origin, int depth, const Visit& visit) {
  if (!tree.nodeHasChildren(&node)) return visit(node, origin, depth);
  for (int i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(&node, i)) {
      for_each_leaf(tree, *tree.getNodeChild(&node, i), child_origin(origin, i, depth), depth + 1,
                    visit);
    }
  }
}

/// The same for all leaves of the tree.
template <class Visit>
void for_each_leaf(const UncertaintyOcTree& tree, const Visit& visit) {
  if (tree.getRoot() != nullptr) for_each_leaf(tree, *tree.getRoot(), VoxelKey{}, 0, visit);
}

}  // namespace nbvopt
