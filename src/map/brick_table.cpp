#include "map/brick_table.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace nbvopt::detail {
namespace {

/// Bricks are 2^11 an axis.
constexpr int kBrickKeys = 65536 / kBrickSize;

std::uint64_t packed(BrickKey key) {
  return static_cast<std::uint64_t>(key.x) | static_cast<std::uint64_t>(key.y) << 16 |
         static_cast<std::uint64_t>(key.z) << 32;
}

struct BrickOrder {
  bool operator()(const BrickKey& a, const BrickKey& b) const {
    return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
  }
};

/// A brick with the codes that follow from its neighbourhood.
std::shared_ptr<const Brick> make_brick(std::shared_ptr<const BrickStates> states,
                                        const BrickNeighbourhood& neighbourhood) {
  if (states->is_all_unknown()) return unknown_brick();
  auto brick = std::make_shared<Brick>();
  compute_codes(neighbourhood, brick->code.data());
  std::fill(brick->code.begin() + kBrickVoxels, brick->code.end(), kUnknownCode);
  brick->states = std::move(states);
  return brick;
}

/// The neighbourhood of a brick from a lookup of states.
template <typename StatesOf>
BrickNeighbourhood neighbourhood_of(BrickKey key, StatesOf&& states_of) {
  BrickNeighbourhood neighbourhood;
  std::size_t i = 0;
  BrickBox{{-1, -1, -1}, {1, 1, 1}}.for_each([&](BrickKey d) {
    neighbourhood[i++] = states_of(BrickKey{key.x + d.x, key.y + d.y, key.z + d.z});
  });
  return neighbourhood;
}

/// A brick's states with some voxels changed.
std::shared_ptr<const BrickStates> with_changes(const BrickStates& before,
                                                std::span<const VoxelChange> changes) {
  auto states = std::make_shared<BrickStates>(before);
  std::vector<float> uncertainty(kBrickVoxels, kUnknownUncertainty);
  for (int row = 0; row < kBrickRows; ++row) {
    for (std::uint32_t left = before.occupied[row]; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      const VoxelKey key{static_cast<std::uint16_t>(x),
                         static_cast<std::uint16_t>(row & kBrickMask),
                         static_cast<std::uint16_t>(row >> kBrickBits)};
      uncertainty[row * kBrickSize + x] = before.uncertainty_of_occupied(key, kUnknownUncertainty);
    }
  }
  for (const VoxelChange& change : changes) {
    const int row = row_of(change.key);
    const std::uint32_t bit = 1U << (change.key.x & kBrickMask);
    states->occupied[row] &= ~bit;
    states->free[row] &= ~bit;
    if (change.state == VoxelState::occupied) states->occupied[row] |= bit;
    if (change.state == VoxelState::free) states->free[row] |= bit;
    uncertainty[index_of(change.key)] = change.uncertainty;
  }
  states->finish(uncertainty.data());
  return states;
}

}  // namespace

BrickTable::BrickTable(const UncertaintyOcTree& tree)
    : tree_(&tree), unknown_(unknown_brick().get()) {
  const std::vector<BrickKey> blocks = known_blocks(tree);
  lay_out(blocks);
  for (const BrickKey& block : blocks) {
    auto& place = blocks_[place_of(block)];
    place = std::make_shared<Block>();
    place->key = block;
  }
}

void BrickTable::lay_out(const std::vector<BrickKey>& blocks) {
  if (blocks.empty()) return;
  BrickKey max = blocks.front();
  min_ = blocks.front();
  for (const BrickKey& b : blocks) {
    min_ = {std::min(min_.x, b.x), std::min(min_.y, b.y), std::min(min_.z, b.z)};
    max = {std::max(max.x, b.x), std::max(max.y, b.y), std::max(max.z, b.z)};
  }
  size_ = {max.x - min_.x + 1, max.y - min_.y + 1, max.z - min_.z + 1};
  blocks_.resize(static_cast<std::size_t>(size_.x) * size_.y * size_.z);
}

const BrickStates* BrickTable::states_of(BrickKey key) const {
  const Block* block = block_of(key);
  if (block == nullptr) return unknown_->states.get();
  if (const Brick* brick = block->ready[slot_of(key)].load(std::memory_order_relaxed)) {
    return brick->states.get();
  }
  auto [entry, is_new] = states_.try_emplace(packed(key));
  if (is_new) {
    entry->second = read_brick(*tree_, key);
    if (entry->second == nullptr) entry->second = unknown_->states;
  }
  return entry->second.get();
}

void BrickTable::read(BrickKey key) const {
  Block* const block = block_of(key);
  if (block == nullptr || block->ready[slot_of(key)].load(std::memory_order_relaxed) != nullptr) {
    return;
  }
  if (states_of(key)->is_all_unknown()) {
    block->store(slot_of(key), unknown_brick());
    return;
  }
  const BrickNeighbourhood neighbourhood =
      neighbourhood_of(key, [this](BrickKey k) { return states_of(k); });
  block->store(slot_of(key), make_brick(states_.at(packed(key)), neighbourhood));
  states_.erase(packed(key));
}

void BrickTable::make_ready(const BrickBox& box) const {
  if (is_whole()) return;
  bool all_ready = true;
  box.for_each([&](BrickKey key) { all_ready = all_ready && ready_brick(key) != nullptr; });
  if (all_ready) return;
  const std::scoped_lock lock(mutex_);
  box.for_each([this](BrickKey key) { read(key); });
}

void BrickTable::read_all() {
  for (const auto& block : blocks_) {
    if (block == nullptr) continue;
    const BrickKey first{block->key.x << kBlockBits, block->key.y << kBlockBits,
                         block->key.z << kBlockBits};
    make_ready(
        {first, {first.x + kBlockSize - 1, first.y + kBlockSize - 1, first.z + kBlockSize - 1}});
  }
  states_.clear();
  tree_ = nullptr;
}

BrickTable::BrickTable(const BrickTable& previous, std::span<const VoxelChange> changes)
    : unknown_(previous.unknown_) {
  std::map<BrickKey, std::vector<VoxelChange>, BrickOrder> changes_of;
  for (const VoxelChange& change : changes) changes_of[brick_of(change.key)].push_back(change);

  std::vector<BrickKey> blocks;
  for (const auto& block : previous.blocks_) {
    if (block != nullptr) blocks.push_back(block->key);
  }
  for (const auto& [brick, unused] : changes_of) blocks.push_back(block_key(brick));
  lay_out(blocks);
  for (const auto& block : previous.blocks_) {
    if (block != nullptr) blocks_[place_of(block->key)] = block;
  }

  // The states of changed bricks first, since codes need the neighbours'.
  std::map<BrickKey, std::shared_ptr<const BrickStates>, BrickOrder> states;
  std::set<BrickKey, BrickOrder> to_code;
  for (const auto& [brick, own_changes] : changes_of) {
    const BrickStates& before = *previous.ready_brick(brick)->states;
    states[brick] = with_changes(before, own_changes);
    to_code.insert(brick);
    for (const VoxelChange& change : own_changes) {
      const bool was_free = before.state(change.key) == VoxelState::free;
      if (was_free == (change.state == VoxelState::free)) continue;
      const auto low = [](int key) { return std::max(key - kCodeReach, 0) >> kBrickBits; };
      const auto high = [](int key) {
        return std::min((key + kCodeReach) >> kBrickBits, kBrickKeys - 1);
      };
      const BrickBox reach{{low(change.key.x), low(change.key.y), low(change.key.z)},
                           {high(change.key.x), high(change.key.y), high(change.key.z)}};
      reach.for_each([&](BrickKey key) { to_code.insert(key); });
    }
  }
  const auto states_of = [&](BrickKey key) {
    const auto changed = states.find(key);
    return changed != states.end() ? changed->second.get()
                                   : previous.ready_brick(key)->states.get();
  };

  std::set<const Block*> own_blocks;
  for (const BrickKey& key : to_code) {
    if (states_of(key)->is_all_unknown() && !states.contains(key)) continue;
    auto& block = blocks_[place_of(block_key(key))];
    if (!own_blocks.contains(block.get())) {
      auto copy = std::make_shared<Block>();
      copy->key = block_key(key);
      for (int slot = 0; slot < kBlockBricks; ++slot) {
        copy->store(slot, block != nullptr ? block->owned[slot] : unknown_brick());
      }
      block = std::move(copy);
      own_blocks.insert(block.get());
    }
    const auto changed = states.find(key);
    block->store(
        slot_of(key),
        make_brick(changed != states.end() ? changed->second : previous.ready_brick(key)->states,
                   neighbourhood_of(key, states_of)));
  }
}

std::size_t BrickTable::memory_bytes() const {
  std::size_t bytes = blocks_.size() * sizeof(blocks_[0]);
  for (const auto& block : blocks_) {
    if (block == nullptr) continue;
    bytes += sizeof(Block);
    for (const auto& ready : block->ready) {
      const Brick* brick = ready.load(std::memory_order_acquire);
      if (brick == nullptr || brick == unknown_) continue;
      bytes +=
          sizeof(Brick) + sizeof(BrickStates) + brick->states->uncertainty.size() * sizeof(float);
    }
  }
  return bytes;
}

}  // namespace nbvopt::detail
