// A branch of the octree as .ot files of type UncertaintyOcTree hold it.
#pragma once

#include <cstdint>
#include <string>

#include "map/append_number.hpp"
#include "map/uncertainty_octree.hpp"

namespace nbvopt {

/// Appends a node as .ot files hold it: its values (append_values) and a mask of its children.
/// Returns the mask.
template <class AppendValues>
std::uint8_t append_full_node(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode& node,
                              const AppendValues& append_values, std::string& bytes) {
  append_values(node, bytes);
  std::uint8_t mask = 0;
  for (int i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(&node, i)) mask |= static_cast<std::uint8_t>(1U << i);
  }
  append(bytes, mask);
  return mask;
}

/// Appends a node, then its children and all below them.
template <class AppendValues>
void append_full_subtree(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode& node,
                         const AppendValues& append_values, std::string& bytes) {
  const std::uint8_t mask = append_full_node(tree, node, append_values, bytes);
  for (int i = 0; i < 8; ++i) {
    if (mask >> i & 1) {
      append_full_subtree(tree, *tree.getNodeChild(&node, i), append_values, bytes);
    }
  }
}

/// A node and how deep it is; null where nothing is known.
struct FoundNode {
  const UncertaintyOcTreeNode* node = nullptr;
  int depth = 0;
};

/// The node at `depth` that covers a voxel, or the leaf above.
FoundNode find_node(const UncertaintyOcTree& tree, VoxelKey key, int depth);

/// Appends a node alone.
void append_node(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode& node,
                 std::string& bytes);

/// Appends a node and all below it.
void append_subtree(const UncertaintyOcTree& tree, const UncertaintyOcTreeNode& node,
                    std::string& bytes);

/// Makes a node what append_subtree() wrote, whatever it was.
void restore_subtree(UncertaintyOcTree& tree, UncertaintyOcTreeNode& node,
                     const std::string& bytes);

}  // namespace nbvopt
