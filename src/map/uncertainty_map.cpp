#include "nbvopt/map/uncertainty_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "map/brick_reader.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

using Node = UncertaintyOcTreeNode;

double checked_resolution(double resolution_m) {
  if (!(resolution_m > 0.0) || !std::isfinite(resolution_m)) {
    throw InputError("resolution: " + std::to_string(resolution_m) +
                     " m, give a positive and finite one");
  }
  return resolution_m;
}

std::uint64_t voxels_covered(int depth) {
  return std::uint64_t{1} << 3 * (UncertaintyOcTree::kDepth - depth);
}

void restore_inner_nodes(UncertaintyOcTree& tree, Node& node) {
  if (!tree.nodeHasChildren(&node)) return;
  for (int i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(&node, i)) restore_inner_nodes(tree, *tree.getNodeChild(&node, i));
  }
  tree.update_inner_node(node);
}

/// The keys that a node covers.
KeyBox covered_keys(VoxelKey origin, int depth) {
  const int last = (1 << (UncertaintyOcTree::kDepth - depth)) - 1;
  return {origin,
          {static_cast<std::uint16_t>(origin.x + last), static_cast<std::uint16_t>(origin.y + last),
           static_cast<std::uint16_t>(origin.z + last)}};
}

bool contains(const KeyBox& outer, const KeyBox& inner) {
  return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
         inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
}

KeyBox joined(const KeyBox& a, const KeyBox& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

void grow_known_box(const UncertaintyOcTree& tree, const Node& node, VoxelKey origin, int depth,
                    std::optional<KeyBox>& box) {
  const KeyBox covered = covered_keys(origin, depth);
  if (box && contains(*box, covered)) return;
  if (!tree.nodeHasChildren(&node)) {
    box = box ? joined(*box, covered) : covered;
    return;
  }
  for (int i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(&node, i)) {
      grow_known_box(tree, *tree.getNodeChild(&node, i), child_origin(origin, i, depth), depth + 1,
                     box);
    }
  }
}

bool any_certain_leaf(const UncertaintyOcTree& tree, const Node& node) {
  if (!tree.isNodeOccupied(&node)) return false;  // an inner node holds its children's maximum
  if (!tree.nodeHasChildren(&node)) {
    return node.uncertainty() < kUnknownUncertainty;
  }
  for (int i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(&node, i) && any_certain_leaf(tree, *tree.getNodeChild(&node, i))) {
      return true;
    }
  }
  return false;
}

}  // namespace

UncertaintyMap::UncertaintyMap(double resolution_m)
    : UncertaintyMap(std::make_unique<UncertaintyOcTree>(checked_resolution(resolution_m))) {}

UncertaintyMap::UncertaintyMap(std::unique_ptr<UncertaintyOcTree> tree, bool is_plain)
    : tree_(std::move(tree)), lattice_(tree_->getResolution()), is_plain_(is_plain) {}

UncertaintyMap::UncertaintyMap(UncertaintyMap&&) noexcept = default;
UncertaintyMap& UncertaintyMap::operator=(UncertaintyMap&&) noexcept = default;
UncertaintyMap::~UncertaintyMap() = default;

VoxelRecord UncertaintyMap::at(VoxelKey key) const {
  const Node* node = tree_->search(octomap_key(key));
  if (node == nullptr) return {};
  const bool is_occupied = tree_->isNodeOccupied(node);
  return {.state = is_occupied ? VoxelState::occupied : VoxelState::free,
          .log_odds = node->getLogOdds(),
          .uncertainty = is_occupied ? node->uncertainty() : kUnknownUncertainty,
          .colour = node->colour()};
}

void UncertaintyMap::set(VoxelKey key, const VoxelRecord& record) {
  if (!std::isfinite(record.log_odds) ||
      !(record.uncertainty >= 0.0F && record.uncertainty <= 1.0F)) {
    throw UsageError("a voxel's log-odds must be finite, its uncertainty in [0, 1]");
  }
  is_plain_ = false;
  Node& node = tree_->make_voxel(key);
  node.setLogOdds(record.log_odds);
  node.set_uncertainty(tree_->isNodeOccupied(&node) ? record.uncertainty : kUnknownUncertainty);
  node.set_colour(record.colour);
}

void UncertaintyMap::finish_writing() {
  if (tree_->getRoot() != nullptr) restore_inner_nodes(*tree_, *tree_->getRoot());
}

MapCounts UncertaintyMap::counts() const {
  MapCounts counts;
  for_each_leaf(*tree_, [&](const Node& leaf, VoxelKey, int depth) {
    const std::uint64_t voxels = voxels_covered(depth);
    ++counts.leaves;
    if (!tree_->isNodeOccupied(&leaf)) {
      counts.free_voxels += voxels;
      return;
    }
    counts.occupied_voxels += voxels;
    if (leaf.uncertainty() < kUnknownUncertainty) counts.certain_voxels += voxels;
    counts.information += static_cast<double>(voxels) * (1.0 - leaf.uncertainty());  // Eq. 10, 11
  });
  counts.nodes = tree_->size();
  return counts;
}

PaperCounts UncertaintyMap::paper_counts() const {
  PaperCounts counts;
  for (auto node = tree_->begin_tree(); node != tree_->end_tree(); ++node) {
    if (node->uncertainty() >= kUnknownUncertainty) continue;
    ++counts.voxels;
    counts.information += 1.0 - node->uncertainty();
  }
  return counts;
}

std::optional<KeyBox> UncertaintyMap::known_box() const {
  std::optional<KeyBox> box;
  if (tree_->getRoot() != nullptr) grow_known_box(*tree_, *tree_->getRoot(), {}, 0, box);
  return box;
}

std::uint64_t UncertaintyMap::known_bricks() const { return detail::count_known_bricks(*tree_); }

std::uint64_t UncertaintyMap::memory_bytes() const {
  // A node is 32 bytes of malloc(), the array of its children 80: one for each four to eight nodes.
  constexpr std::uint64_t kBytesPerNode = 50;
  return tree_->size() * kBytesPerNode;
}

bool UncertaintyMap::has_occupied() const {
  return tree_->getRoot() != nullptr && tree_->isNodeOccupied(tree_->getRoot());
}

bool UncertaintyMap::carries_uncertainty() const {
  if (is_plain_) return false;
  return tree_->getRoot() != nullptr && any_certain_leaf(*tree_, *tree_->getRoot());
}

}  // namespace nbvopt
