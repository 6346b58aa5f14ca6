#include "map/subtree.hpp"

#include <type_traits>

#include "map/byte_reader.hpp"

namespace nbvopt {

namespace {

using Node = UncertaintyOcTreeNode;

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

void append_subtree(const UncertaintyOcTree& tree, const Node& node, std::string& bytes) {
  const auto append_values = [](const Node& each, std::string& to) {
    append(to, each.getLogOdds());
    append(to, each.colour());
    append(to, each.uncertainty());
  };
  append_full_node(tree, node, append_values, bytes);
}

void restore_subtree(UncertaintyOcTree& tree, Node& node, const std::string& bytes) {
  tree.delete_children(node);
  read_subtree(tree, node, bytes.data());
}

}  // namespace nbvopt
