#include <array>
#include <cstdint>
#include <string>

#include "core/atomic_file.hpp"
#include "map/append_number.hpp"
#include "map/map_access.hpp"
#include "map/map_header.hpp"
#include "map/map_points.hpp"
#include "map/subtree.hpp"
#include "map/tree_reader.hpp"
#include "nbvopt/map/colour_ramp.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

namespace {

using Node = UncertaintyOcTreeNode;

std::string uncertainty_file(const UncertaintyOcTree& tree) {
  std::string bytes =
      map_file_header(kFullMagic, kUncertaintyType, tree.size(), tree.getResolution());
  if (tree.getRoot() != nullptr) append_subtree(tree, *tree.getRoot(), bytes);
  return bytes;
}

Colour shown_colour(const UncertaintyOcTree& tree, const Node& node) {
  return tree.isNodeOccupied(&node) ? uncertainty_colour(node.uncertainty()) : kNoColour;
}

std::string colour_file(const UncertaintyOcTree& tree) {
  const auto append_values = [&tree](const Node& node, std::string& to) {
    append(to, node.getLogOdds());
    append(to, shown_colour(tree, node));
  };
  std::string bytes = map_file_header(kFullMagic, "ColorOcTree", tree.size(), tree.getResolution());
  if (tree.getRoot() != nullptr) append_full_subtree(tree, *tree.getRoot(), append_values, bytes);
  return bytes;
}

/// Writes the most likely state of each voxel, pruned: two bits a child.
class BinaryWriter {
 public:
  explicit BinaryWriter(const UncertaintyOcTree& tree) : tree_(tree) {}

  std::string file() && {
    if (const Node* root = tree_.getRoot(); root != nullptr) {
      ++nodes_;
      append_children(*root);
    }
    return map_file_header(kBinaryMagic, "OcTree", nodes_, tree_.getResolution()) + bytes_;
  }

 private:
  enum Code : std::uint16_t { unknown = 0, free = 1, occupied = 2, inner = 3 };

  /// Appends the codes of all children, then what is under the inner ones. Returns the codes.
  std::uint16_t append_children(const Node& node) {
    const std::size_t codes_at = bytes_.size();
    bytes_.append(sizeof(std::uint16_t), '\0');
    std::uint16_t codes = 0;
    for (int i = 0; i < 8; ++i) codes |= static_cast<std::uint16_t>(append_child(node, i) << 2 * i);
    bytes_[codes_at] = static_cast<char>(codes & 0xFF);
    bytes_[codes_at + 1] = static_cast<char>(codes >> 8);
    return codes;
  }

  Code append_child(const Node& node, int index) {
    // The format has no code for a root that is a leaf: it is written as eight equal children.
    const bool is_leaf_root = !tree_.nodeHasChildren(&node);
    if (!is_leaf_root && !tree_.nodeChildExists(&node, index)) return unknown;
    const Node& child = is_leaf_root ? node : *tree_.getNodeChild(&node, index);
    ++nodes_;
    if (!tree_.nodeHasChildren(&child)) return tree_.isNodeOccupied(&child) ? occupied : free;

    const std::size_t bytes_before = bytes_.size();
    const std::uint64_t nodes_before = nodes_;
    const std::uint16_t codes = append_children(child);
    const bool all_free = codes == 0x5555;
    const bool all_occupied = codes == 0xAAAA;
    if (!all_free && !all_occupied) return inner;
    bytes_.resize(bytes_before);
    nodes_ = nodes_before;
    return all_free ? free : occupied;
  }

  const UncertaintyOcTree& tree_;
  std::string bytes_;
  std::uint64_t nodes_ = 0;
};

}  // namespace

std::string map_file_bytes(const UncertaintyMap& map, MapFormat format, MapPoints points) {
  switch (format) {
    case MapFormat::uncertainty_ot:
      return uncertainty_file(detail::MapAccess::tree(map));
    case MapFormat::bt:
      return BinaryWriter(detail::MapAccess::tree(map)).file();
    case MapFormat::colour_ot:
      return colour_file(detail::MapAccess::tree(map));
    case MapFormat::colour_ply:
      return ply_file(map, points);
    case MapFormat::colour_pcd:
      return pcd_file(map, points);
  }
  return {};
}

void write_map(const UncertaintyMap& map, const std::filesystem::path& path, MapFormat format,
               MapPoints points) {
  write_file_atomically(path, map_file_bytes(map, format, points));
}

}  // namespace nbvopt
