#include "map/brick_reader.hpp"

#include <algorithm>

#include "map/uncertainty_octree.hpp"

namespace nbvopt::detail {
namespace {

constexpr int kBrickDepth = UncertaintyOcTree::kDepth - kBrickBits;

/// The states of a brick while its leaves come in. Coordinates are voxels from the brick's first.
class BrickFiller {
 public:
  explicit BrickFiller(const UncertaintyOcTree& tree) : tree_(tree) {}

  /// The node spans the cube of `size` voxels, at most a brick, from (x, y, z) on.
  void fill(const UncertaintyOcTreeNode& node, int x, int y, int z, int size) {
    if (!tree_.nodeHasChildren(&node)) {
      fill_leaf(node, x, y, z, size);
    } else if (size == 2) {
      fill_voxels(node, x, y, z);
    } else {
      fill_children(node, x, y, z, size, kAllOctants);
    }
  }

  /// The same for some octants of a node that is no leaf.
  void fill_children(const UncertaintyOcTreeNode& node, int x, int y, int z, int size,
                     Octants octants) {
    const int half = size / 2;
    for (int child = 0; child < 8; ++child) {
      if ((octants >> child & 1) == 0 || !tree_.nodeChildExists(&node, child)) continue;
      fill(*tree_.getNodeChild(&node, child), x + (child & 1 ? half : 0),
           y + (child & 2 ? half : 0), z + (child & 4 ? half : 0), half);
    }
  }

  std::shared_ptr<const BrickStates> finish() {
    states_->finish(uncertainty_.empty() ? nullptr : uncertainty_.data());
    return std::move(states_);
  }

 private:
  /// The leaves are the eight voxels from (x, y, z) on. Nine in ten nodes are such leaves, in no
  /// order that a processor could foresee: hence no branches on what they are.
  void fill_voxels(const UncertaintyOcTreeNode& node, int x, int y, int z) {
    unsigned occupied = 0;
    unsigned known = 0;
    bool is_certain = false;
    for (int child = 0; child < 8; ++child) {
      const bool exists = tree_.nodeChildExists(&node, child);
      const UncertaintyOcTreeNode& voxel = exists ? *tree_.getNodeChild(&node, child) : node;
      const bool is_occupied = exists & tree_.isNodeOccupied(voxel);
      known |= unsigned{exists} << child;
      occupied |= unsigned{is_occupied} << child;
      is_certain |= is_occupied & (voxel.uncertainty() != kUnknownUncertainty);
    }
    const int first_row = y | z << kBrickBits;
    for (int pair = 0; pair < 4; ++pair) {
      const int row = first_row + (pair & 1) + (pair >> 1) * kBrickSize;
      states_->occupied[row] |= (occupied >> 2 * pair & 3U) << x;
      states_->free[row] |= ((known & ~occupied) >> 2 * pair & 3U) << x;
    }
    if (!is_certain) return;
    for (unsigned left = occupied; left != 0; left &= left - 1) {
      const int child = std::countr_zero(left);
      const int row = first_row + (child >> 1 & 1) + (child >> 2) * kBrickSize;
      set_uncertainty(row, x + (child & 1), 1, tree_.getNodeChild(&node, child)->uncertainty());
    }
  }

  /// u of `size` occupied voxels of a row, from x on.
  void set_uncertainty(int row, int x, int size, float uncertainty) {
    if (uncertainty_.empty()) uncertainty_.assign(kBrickVoxels, kUnknownUncertainty);
    std::fill_n(&uncertainty_[row * kBrickSize + x], size, uncertainty);
  }

  void fill_leaf(const UncertaintyOcTreeNode& leaf, int x, int y, int z, int size) {
    const bool occupied = tree_.isNodeOccupied(leaf);
    auto& rows = occupied ? states_->occupied : states_->free;
    const auto bits = static_cast<std::uint32_t>(((std::uint64_t{1} << size) - 1) << x);
    const int first_row = y | z << kBrickBits;
    for (int dz = 0; dz < size; ++dz) {
      for (int dy = 0; dy < size; ++dy) rows[first_row + dy + dz * kBrickSize] |= bits;
    }
    if (occupied && leaf.uncertainty() != kUnknownUncertainty) {
      for (int dz = 0; dz < size; ++dz) {
        for (int dy = 0; dy < size; ++dy) {
          set_uncertainty(first_row + dy + dz * kBrickSize, x, size, leaf.uncertainty());
        }
      }
    }
  }

  const UncertaintyOcTree& tree_;
  std::shared_ptr<BrickStates> states_ = std::make_shared<BrickStates>();
  std::vector<float> uncertainty_;  ///< one a voxel; empty while none differs from 1
};

/// `node` spans 2^levels blocks an axis from `block` on.
void collect_blocks(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode* node,
                    BrickKey block, int levels, std::vector<BrickKey>& blocks) {
  if (levels == 0) {
    blocks.push_back(block);
    return;
  }
  const int half = 1 << (levels - 1);
  for (int child = 0; child < 8; ++child) {
    // All parts of a pruned leaf are like it.
    const bool is_leaf = !tree.nodeHasChildren(node);
    if (!is_leaf && !tree.nodeChildExists(node, child)) continue;
    collect_blocks(tree, is_leaf ? node : tree.getNodeChild(node, child),
                   {block.x + (child & 1 ? half : 0), block.y + (child & 2 ? half : 0),
                    block.z + (child & 4 ? half : 0)},
                   levels - 1, blocks);
  }
}

std::uint64_t count_bricks(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode& node,
                           int depth) {
  if (depth == kBrickDepth) return 1;
  if (!tree.nodeHasChildren(&node)) return std::uint64_t{1} << 3 * (kBrickDepth - depth);
  std::uint64_t bricks = 0;
  for (int child = 0; child < 8; ++child) {
    if (tree.nodeChildExists(&node, child)) {
      bricks += count_bricks(tree, *tree.getNodeChild(&node, child), depth + 1);
    }
  }
  return bricks;
}

}  // namespace

std::uint64_t count_known_bricks(const UncertaintyOcTree& tree) {
  return tree.getRoot() == nullptr ? 0 : count_bricks(tree, *tree.getRoot(), 0);
}

std::vector<BrickKey> known_blocks(const UncertaintyOcTree& tree) {
  std::vector<BrickKey> blocks;
  if (tree.getRoot() != nullptr) {
    collect_blocks(tree, tree.getRoot(), {0, 0, 0}, kBrickDepth - kBlockBits, blocks);
  }
  return blocks;
}

std::shared_ptr<const BrickStates> read_brick(const UncertaintyOcTree& tree, BrickKey brick,
                                              Octants octants) {
  const UncertaintyOcTreeNode* node = tree.getRoot();
  for (int bit = kBrickDepth - 1; bit >= 0 && node != nullptr; --bit) {
    if (!tree.nodeHasChildren(node)) break;  // a pruned leaf that covers the brick
    const int child = (brick.x >> bit & 1) | (brick.y >> bit & 1) << 1 | (brick.z >> bit & 1) << 2;
    node = tree.nodeChildExists(node, child) ? tree.getNodeChild(node, child) : nullptr;
  }
  if (node == nullptr) return nullptr;
  BrickFiller filler(tree);
  if (tree.nodeHasChildren(node)) {
    filler.fill_children(*node, 0, 0, 0, kBrickSize, octants);
  } else {
    filler.fill(*node, 0, 0, 0, kBrickSize);
  }
  return filler.finish();
}

}  // namespace nbvopt::detail
