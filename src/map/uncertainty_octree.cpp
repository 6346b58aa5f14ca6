#include "map/uncertainty_octree.hpp"

#include <algorithm>
#include <limits>

namespace nbvopt {

void UncertaintyOcTreeNode::updateOccupancyChildren() {
  float max_log_odds = std::numeric_limits<float>::lowest();
  float max_uncertainty = 0.0F;
  std::array<int, 3> colour_sum{};
  int coloured = 0;
  for (int i = 0; i < 8; ++i) {
    if (children[i] == nullptr) continue;
    const auto& child = static_cast<const UncertaintyOcTreeNode&>(*children[i]);
    max_log_odds = std::max(max_log_odds, child.getLogOdds());
    max_uncertainty = std::max(max_uncertainty, child.uncertainty());
    if (child.colour() == kNoColour) continue;
    for (int c = 0; c < 3; ++c) colour_sum[c] += child.colour()[c];
    ++coloured;
  }
  setLogOdds(max_log_odds);
  uncertainty_ = max_uncertainty;
  colour_ = kNoColour;
  for (int c = 0; c < 3 && coloured > 0; ++c) {
    colour_[c] = static_cast<std::uint8_t>(colour_sum[c] / coloured);
  }
}

UncertaintyOcTreeNode& UncertaintyOcTree::make_root() {
  if (root == nullptr) {
    root = new Node;
    ++tree_size;
    size_changed = true;
  }
  return *root;
}

UncertaintyOcTreeNode& UncertaintyOcTree::make_voxel(VoxelKey key) {
  const octomap::OcTreeKey octree_key = octomap_key(key);
  bool is_new = root == nullptr;
  Node* node = &make_root();
  for (int depth = 0; depth < kDepth; ++depth) {
    if (!is_new && !nodeHasChildren(node)) expandNode(node);
    const unsigned index = octomap::computeChildIdx(octree_key, kDepth - 1 - depth);
    is_new = !nodeChildExists(node, index);
    node = is_new ? createNodeChild(node, index) : getNodeChild(node, index);
  }
  return *node;
}

void UncertaintyOcTree::delete_children(Node& node) {
  for (unsigned i = 0; i < 8; ++i) {
    if (!nodeChildExists(&node, i)) continue;
    delete_children(*getNodeChild(&node, i));
    deleteNodeChild(&node, i);
  }
  node.free_child_array();
}

}  // namespace nbvopt
