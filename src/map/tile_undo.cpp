#include "map/tile_undo.hpp"

#include "map/subtree.hpp"
#include "map/tile_update.hpp"

namespace nbvopt {

void TileUndo::keep(VoxelKey tile) {
  kept_.push_back({tile, {}});
  const Node* node = find_node(tree_, tile, kTileDepth).node;
  if (node != nullptr) append_subtree(tree_, *node, kept_.back().bytes);
}

void TileUndo::restore() {
  for (const Kept& kept : kept_) {
    if (tree_.getRoot() != nullptr && !restore(*tree_.getRoot(), 0, kept)) tree_.clear();
  }
  kept_.clear();
}

bool TileUndo::restore(Node& node, int depth, const Kept& kept) {
  if (depth == kTileDepth) {
    if (kept.bytes.empty()) {
      tree_.delete_children(node);
      return false;
    }
    restore_subtree(tree_, node, kept.bytes);
    return true;
  }
  const unsigned index =
      octomap::computeChildIdx(octomap_key(kept.tile), UncertaintyOcTree::kDepth - 1 - depth);
  if (!tree_.nodeHasChildren(&node)) tree_.expandNode(&node);  // pruned since
  if (!restore(*tree_.getNodeChild(&node, index), depth + 1, kept)) {
    tree_.deleteNodeChild(&node, index);
    if (!tree_.nodeHasChildren(&node)) {
      node.free_child_array();
      return false;
    }
  }
  tree_.update_inner_node(node);
  return true;
}

}  // namespace nbvopt
