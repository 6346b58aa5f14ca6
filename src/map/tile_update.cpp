#include "map/tile_update.hpp"

#include <algorithm>

namespace nbvopt {

namespace {

/// The scan's mean colour of the voxel, averaged with the one that it had, as OctoMap does.
Colour fused_colour(const Colour& before, const HitVoxel& hit) {
  Colour colour{};
  for (int c = 0; c < 3; ++c) {
    std::uint32_t value = hit.colour_sum[c] / hit.coloured_points;
    if (before != kNoColour) value = (value + before[c]) / 2;
    colour[c] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

}  // namespace

void TileUpdate::apply(std::uint32_t tile) {
  if (window_.content(MarkWindow::kTileBits, tile) == kUntouched) return;
  result_.tiles.push_back(window_.key(tile << 3 * MarkWindow::kTileBits));
  const bool is_new = tree_.getRoot() == nullptr;
  descend(tree_.make_root(), is_new, 0, tile);
}

void TileUpdate::descend(Node& node, bool is_new, int depth, std::uint32_t tile) {
  if (depth == kTileDepth) return update_block(node, is_new, MarkWindow::kTileBits, tile);
  const octomap::OcTreeKey key = octomap_key(window_.key(tile << 3 * MarkWindow::kTileBits));
  const unsigned index = octomap::computeChildIdx(key, UncertaintyOcTree::kDepth - 1 - depth);
  if (!is_new && !tree_.nodeHasChildren(&node)) tree_.expandNode(&node);
  bool child_is_new = false;
  Node& next = child(node, static_cast<int>(index), child_is_new);
  descend(next, child_is_new, depth + 1, tile);
  tree_.update_inner_node(node);
}

void TileUpdate::update_block(Node& node, bool is_new, int level, std::uint32_t block) {
  const std::uint8_t content = window_.content(level, block);
  const bool is_leaf = is_new || !tree_.nodeHasChildren(&node);
  if (level == 0 || (is_leaf && content == kPassed)) {
    return update_leaf(node, is_new, level, block);
  }
  if (is_leaf && !is_new) {
    if ((content & kHit) == 0 && is_settled_free(node)) return;
    tree_.expandNode(&node);
  }
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t child_block = 8 * block + static_cast<std::uint32_t>(i);
    if (window_.content(level - 1, child_block) == kUntouched) continue;
    bool child_is_new = false;
    Node& next = child(node, i, child_is_new);
    update_block(next, child_is_new, level - 1, child_block);
  }
  tree_.update_inner_node(node);
}

void TileUpdate::update_leaf(Node& leaf, bool is_new, int level, std::uint32_t block) {
  const auto state_of = [this](const Node& node) {
    return tree_.isNodeOccupied(&node) ? VoxelState::occupied : VoxelState::free;
  };
  const VoxelState state_before = is_new ? VoxelState::unknown : state_of(leaf);
  const float uncertainty_before =
      state_before == VoxelState::occupied ? leaf.uncertainty() : kUnknownUncertainty;

  if (window_.content(level, block) == kHit) {
    tree_.integrateHit(&leaf);
  } else {
    tree_.integrateMiss(&leaf);
  }
  const VoxelState state = state_of(leaf);
  if (state == VoxelState::free) {
    leaf.set_uncertainty(kUnknownUncertainty);
    leaf.set_colour(kNoColour);
  } else if (window_.content(level, block) == kHit) {
    const HitVoxel& hit = window_.hit(block);
    leaf.set_uncertainty(std::min(uncertainty_before, hit.uncertainty));  // Equation (9)
    if (hit.coloured_points > 0) leaf.set_colour(fused_colour(leaf.colour(), hit));
  }
  if (state == state_before && leaf.uncertainty() == uncertainty_before) return;
  const std::uint32_t voxels = 1U << 3 * level;
  const auto is_certain = [](float uncertainty) { return uncertainty < kUnknownUncertainty; };
  result_.information_gained +=
      voxels * (double{uncertainty_before} - double{leaf.uncertainty()});  // Equations (10), (11)
  result_.certain_voxels_gained +=
      static_cast<std::int64_t>(voxels) *
      (int{is_certain(leaf.uncertainty())} - int{is_certain(uncertainty_before)});
  for (std::uint32_t number = block * voxels; number < (block + 1) * voxels; ++number) {
    result_.changes.push_back({window_.key(number), state, leaf.uncertainty()});
  }
}

/// Whether passing through the leaf once more changes nothing.
bool TileUpdate::is_settled_free(const Node& leaf) const {
  return leaf.getLogOdds() == tree_.getClampingThresMinLog() &&
         leaf.uncertainty() == kUnknownUncertainty && leaf.colour() == kNoColour;
}

UncertaintyOcTreeNode& TileUpdate::child(Node& node, int index, bool& is_new) {
  is_new = !tree_.nodeChildExists(&node, index);
  return is_new ? *tree_.createNodeChild(&node, index) : *tree_.getNodeChild(&node, index);
}

}  // namespace nbvopt
