#include "map/subtree.hpp"

#include <type_traits>

#include "map/byte_reader.hpp"

namespace nbvopt {

namespace {

using Node = UncertaintyOcTreeNode;

void append_all_values(const Node& node, std::string& bytes) {
  append(bytes, node.getLogOdds());
  append(bytes, node.colour());
  append(bytes, node.uncertainty());
}

/// Fills a node without children from its bytes; returns where they end.
const char* read_subtree(UncertaintyOcTree& tree, Node& node, const char* bytes) {
  const auto take = [&bytes](auto& value) {
    value = number_at<std::remove_reference_t<decltype(value)>>(bytes);
    bytes += sizeof(value);
  };
  float log_odds = 0.0F;
  Colour colour = kNoColour;
  float uncertainty = kUnknownUncertainty;
  std::uint8_t mask = 0;
  take(log_odds);
  take(colour);
  take(uncertainty);
  take(mask);
  node.setLogOdds(log_odds);
  node.set_colour(colour);
  node.set_uncertainty(uncertainty);
  for (int i = 0; i < 8; ++i) {
    if (mask >> i & 1) bytes = read_subtree(tree, *tree.createNodeChild(&node, i), bytes);
  }
  return bytes;
}

}  // namespace

FoundNode find_node(const UncertaintyOcTree& tree, VoxelKey key, int depth) {
  FoundNode found{tree.getRoot(), 0};
  while (found.node != nullptr && found.depth < depth && tree.nodeHasChildren(found.node)) {
    const unsigned index =
        octomap::computeChildIdx(octomap_key(key), UncertaintyOcTree::kDepth - 1 - found.depth);
    const bool is_known = tree.nodeChildExists(found.node, index);
    found = {is_known ? tree.getNodeChild(found.node, index) : nullptr, found.depth + 1};
  }
  return found;
}

void append_node(const UncertaintyOcTree& tree, const Node& node, std::string& bytes) {
  append_full_node(tree, node, append_all_values, bytes);
}

void append_subtree(const UncertaintyOcTree& tree, const Node& node, std::string& bytes) {
  append_full_subtree(tree, node, append_all_values, bytes);
}

void restore_subtree(UncertaintyOcTree& tree, Node& node, const std::string& bytes) {
  tree.delete_children(node);
  read_subtree(tree, node, bytes.data());
}

}  // namespace nbvopt
