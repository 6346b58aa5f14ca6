// Takes back what a scan has written so far.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "map/uncertainty_octree.hpp"

namespace nbvopt {

/// Remembers the octree's branches in the tiles of MarkWindow before they are written.
class TileUndo {
 public:
  explicit TileUndo(UncertaintyOcTree& tree) : tree_(tree) {}

  /// Remembers a tile, by its least key; call once, before it is written, and write it then.
  void keep(VoxelKey tile);

  /// Makes the tiles what they were; inner nodes above them hold what their children say.
  void restore();

 private:
  using Node = UncertaintyOcTreeNode;
  struct Kept {
    VoxelKey tile;
    std::string bytes;  ///< empty: nothing was known
  };

  /// Returns whether anything is known below the node.
  bool restore(Node& node, int depth, const Kept& kept);

  UncertaintyOcTree& tree_;
  std::vector<Kept> kept_;
};

}  // namespace nbvopt
