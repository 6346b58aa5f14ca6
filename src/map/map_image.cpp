#include "map/map_image.hpp"

#include <string>
#include <utility>

#include "map/map_access.hpp"
#include "map/map_header.hpp"
#include "map/subtree.hpp"
#include "map/tile_update.hpp"
#include "map/tree_reader.hpp"

namespace nbvopt {

namespace {

using Node = UncertaintyOcTreeNode;

/// Calls enter(node) for the nodes above the tiles and tile(node, least key) for those at their
/// depth, in the order of files.
template <class Enter, class Tile>
void for_each_tile(const UncertaintyOcTree& tree, const Node& node, VoxelKey origin, int depth,
                   const Enter& enter, const Tile& tile) {
  if (depth == kTileDepth) return tile(node, origin);
  enter(node);
  for (int i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(&node, i)) {
      for_each_tile(tree, *tree.getNodeChild(&node, i), child_origin(origin, i, depth), depth + 1,
                    enter, tile);
    }
  }
}

template <class Enter, class Tile>
void for_each_tile(const UncertaintyOcTree& tree, const Enter& enter, const Tile& tile) {
  if (tree.getRoot() != nullptr) for_each_tile(tree, *tree.getRoot(), {}, 0, enter, tile);
}

}  // namespace

void MapImage::forget(std::span<const VoxelKey> tiles) {
  for (const VoxelKey& tile : tiles) {
    const auto piece = pieces_.find(packed(tile));
    if (piece == pieces_.end()) continue;
    bytes_ -= piece->second->capacity();
    pieces_.erase(piece);
  }
}

void MapImage::forget_all() {
  pieces_.clear();
  bytes_ = 0;
}

std::vector<VoxelKey> MapImage::missing(const UncertaintyMap& map) const {
  std::vector<VoxelKey> tiles;
  for_each_tile(
      detail::MapAccess::tree(map), [](const Node&) {},
      [&](const Node&, VoxelKey tile) {
        if (!pieces_.contains(packed(tile))) tiles.push_back(tile);
      });
  return tiles;
}

void MapImage::copy(const UncertaintyMap& map, VoxelKey tile) {
  const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
  const FoundNode found = find_node(tree, tile, kTileDepth);
  if (found.node == nullptr || found.depth != kTileDepth) return;
  std::string bytes;
  append_subtree(tree, *found.node, bytes);
  forget({&tile, 1});
  const SharedBytes::Piece piece = held_.hold(std::move(bytes));
  bytes_ += piece->capacity();
  pieces_[packed(tile)] = piece;
}

SharedBytes MapImage::file(const UncertaintyMap& map) {
  const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
  SharedBytes file;
  std::string between =
      map_file_header(kFullMagic, kUncertaintyType, tree.size(), tree.getResolution());
  for_each_tile(
      tree, [&](const Node& node) { append_node(tree, node, between); },
      [&](const Node&, VoxelKey tile) {
        if (!pieces_.contains(packed(tile))) copy(map, tile);
        if (!between.empty()) file.append(std::exchange(between, {}));
        file.append(pieces_.at(packed(tile)));
      });
  if (!between.empty()) file.append(std::move(between));
  return file;
}

}  // namespace nbvopt
