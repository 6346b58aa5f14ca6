// Writes what a scan says of one tile into the octree.
#pragma once

#include <cstdint>

#include "map/mark_window.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// Of the octree's nodes that cover a tile each.
inline constexpr int kTileDepth = UncertaintyOcTree::kDepth - MarkWindow::kTileBits;

/// Updates the voxels of one tile in one pass over the octree's branch, which is restored and
/// pruned on the way back. Untouched branches are not visited.
class TileUpdate {
 public:
  /// Changes are appended to those of the result in the order of the window's voxels, and what they
  /// gain is added.
  TileUpdate(UncertaintyOcTree& tree, const MarkWindow& window, InsertResult& result)
      : tree_(tree), window_(window), result_(result) {}

  /// Updates one tile of the window.
  void apply(std::uint32_t tile);

 private:
  using Node = UncertaintyOcTreeNode;

  void descend(Node& node, bool is_new, int depth, std::uint32_t tile);
  void update_block(Node& node, bool is_new, int level, std::uint32_t block);
  void update_leaf(Node& leaf, bool is_new, int level, std::uint32_t block);
  bool is_settled_free(const Node& leaf) const;
  Node& child(Node& node, int index, bool& is_new);

  UncertaintyOcTree& tree_;
  const MarkWindow& window_;
  InsertResult& result_;
};

}  // namespace nbvopt
