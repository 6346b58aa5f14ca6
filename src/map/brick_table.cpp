#include "map/brick_table.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::detail {
namespace {

/// Bricks are 2^11 an axis.
constexpr int kBrickKeys = 65536 / kBrickSize;

/// A box beyond this, 2 x 10^11 voxels, is a mistake in the sensor's range or the map's resolution.
constexpr double kMaxBoxBricks = 1 << 22;

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

/// Runs `run` on each item on all cores. Isolated: while it waits, the calling thread, which holds
/// the table's lock, must not take up a task that wants the lock.
template <typename Items, typename Run>
void for_each_in_parallel(Items& items, const Run& run) {
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) { run(items[i]); });
  });
}

/// A brick and its 26 neighbours.
BrickBox box_around(BrickKey key) {
  return {{key.x - 1, key.y - 1, key.z - 1}, {key.x + 1, key.y + 1, key.z + 1}};
}

/// The octants of `near`, a brick or its neighbour, into which the codes of `key` reach.
Octants octants_towards(BrickKey key, BrickKey near) {
  static_assert(kCodeReach == kBrickSize / 2);
  // By axis, the octants of the lower half.
  constexpr std::array<unsigned, 3> kLower{0x55, 0x33, 0x0F};
  unsigned octants = kAllOctants;
  const auto keep = [&](unsigned lower, int step) {
    if (step != 0) octants &= step > 0 ? lower : ~lower;
  };
  keep(kLower[0], near.x - key.x);
  keep(kLower[1], near.y - key.y);
  keep(kLower[2], near.z - key.z);
  return static_cast<Octants>(octants);
}

/// The neighbourhood of a brick from a lookup of states.
template <typename StatesOf>
BrickNeighbourhood neighbourhood_of(BrickKey key, StatesOf&& states_of) {
  BrickNeighbourhood neighbourhood;
  std::size_t i = 0;
  box_around(key).for_each([&](BrickKey near) { neighbourhood[i++] = states_of(near); });
  return neighbourhood;
}

/// A brick's states with some voxels changed.
std::shared_ptr<const BrickStates> with_changes(const BrickStates& before,
                                                std::span<const VoxelChange> changes) {
  auto states = std::make_shared<BrickStates>(before);
  std::vector<float> uncertainty(kBrickVoxels, kUnknownUncertainty);
  if (!before.uncertainty.empty()) {
    auto next = before.uncertainty.begin();  // in the order of the occupied voxels
    for (int row = 0; row < kBrickRows; ++row) {
      for (std::uint32_t left = before.occupied[row]; left != 0; left &= left - 1) {
        uncertainty[row * kBrickSize + std::countr_zero(left)] = *next++;
      }
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

void check_size(const BrickBox& box) {
  if (box.size() > kMaxBoxBricks) {
    throw InputError("the views reach over " + format_number(box.size()) +
                     " bricks of 32 voxels a side, more than " + format_number(kMaxBoxBricks) +
                     ": lower sensor.range_max_m or take a coarser map");
  }
}

std::vector<BrickKey> brick_keys_of(const BrickBox& box) {
  check_size(box);
  std::vector<BrickKey> keys;
  keys.reserve(static_cast<std::size_t>(box.size()));
  box.for_each([&](BrickKey key) { keys.push_back(key); });
  return keys;
}

BrickTable::Block* BrickTable::unknown_block() {
  static const std::unique_ptr<Block> block = [] {
    auto b = std::make_unique<Block>();
    for (int slot = 0; slot < kBlockBricks; ++slot) b->store(slot, unknown_brick());
    return b;
  }();
  return block.get();
}

BrickTable::BrickTable(const UncertaintyOcTree& tree) : tree_(&tree) {
  const std::vector<BrickKey> known = known_blocks(tree);
  lay_out(known);
  for (const BrickKey& block : known) blocks_[place_of(block)] = nullptr;
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
  const std::size_t places = static_cast<std::size_t>(size_.x) * size_.y * size_.z;
  blocks_ = std::vector<std::atomic<Block*>>(places);
  for (auto& block : blocks_) block = unknown_block_;
  owned_blocks_.resize(places);
}

void BrickTable::own(std::shared_ptr<Block> block) const {
  const int place = place_of(block->key);
  blocks_[place].store(block.get(), std::memory_order_release);
  owned_blocks_[place] = std::move(block);
}

const std::shared_ptr<const BrickStates>& BrickTable::states_of(BrickKey key) const {
  const Brick* brick = ready_brick(key);
  return brick != nullptr ? brick->states : states_.at(packed(key)).states;
}

void BrickTable::make_ready(const std::vector<BrickKey>& wanted) const {
  if (is_whole()) return;
  const auto is_missing = [this](BrickKey key) { return ready_brick(key) == nullptr; };
  if (std::ranges::none_of(wanted, is_missing)) return;
  const std::scoped_lock lock(mutex_);
  if (is_whole()) return;
  std::vector<BrickKey> missing;
  std::ranges::copy_if(wanted, std::back_inserter(missing), is_missing);

  // Codes need the neighbours' states too.
  std::unordered_map<std::uint64_t, std::pair<BrickKey, Octants>> needed;
  for (const BrickKey& key : missing) {
    box_around(key).for_each([&](BrickKey near) {
      if (is_missing(near)) {
        auto& [brick, octants] = needed[packed(near)];
        brick = near;
        octants |= octants_towards(key, near);
      }
    });
  }
  std::vector<std::pair<BrickKey, ReadStates*>> to_read;
  for (const auto& [place, need] : needed) {
    ReadStates& read = states_[place];
    if ((need.second & ~read.octants) == 0) continue;
    read = {unknown_brick()->states, static_cast<Octants>(read.octants | need.second)};
    to_read.emplace_back(need.first, &read);
  }
  for_each_in_parallel(to_read, [&tree = *tree_.load()](auto& brick) {
    ReadStates& read = *brick.second;
    if (auto states = read_brick(tree, brick.first, read.octants)) read.states = std::move(states);
  });

  std::vector<std::pair<BrickKey, std::shared_ptr<const Brick>>> bricks;
  for (const BrickKey& key : missing) bricks.emplace_back(key, nullptr);
  for_each_in_parallel(bricks, [this](auto& brick) {
    const auto raw_states_of = [this](BrickKey key) { return states_of(key).get(); };
    brick.second = make_brick(states_of(brick.first), neighbourhood_of(brick.first, raw_states_of));
  });
  for (auto& [key, brick] : bricks) {
    if (block_of(key) == nullptr) {
      auto block = std::make_shared<Block>();
      block->key = block_key(key);
      own(std::move(block));
    }
    block_of(key)->store(slot_of(key), std::move(brick));
    states_.erase(packed(key));
  }
}

void BrickTable::read_all() {
  const BrickBox blocks{min_, {min_.x + size_.x - 1, min_.y + size_.y - 1, min_.z + size_.z - 1}};
  blocks.for_each([this](BrickKey block) {
    const BrickKey first{block.x << kBlockBits, block.y << kBlockBits, block.z << kBlockBits};
    if (block_of(first) == unknown_block_) return;
    make_ready(brick_keys_of(
        {first, {first.x + kBlockSize - 1, first.y + kBlockSize - 1, first.z + kBlockSize - 1}}));
  });
  const std::scoped_lock lock(mutex_);
  states_.clear();
  tree_ = nullptr;
}

BrickTable::BrickTable(const BrickTable& previous, std::span<const VoxelChange> changes) {
  std::map<BrickKey, std::vector<VoxelChange>, BrickOrder> changes_of;
  for (const VoxelChange& change : changes) changes_of[brick_of(change.key)].push_back(change);

  std::vector<BrickKey> blocks;
  for (const auto& block : previous.owned_blocks_) {
    if (block != nullptr) blocks.push_back(block->key);
  }
  for (const auto& [brick, unused] : changes_of) blocks.push_back(block_key(brick));
  lay_out(blocks);
  for (const auto& block : previous.owned_blocks_) {
    if (block != nullptr) own(block);
  }

  // The states of changed bricks first, since codes need the neighbours'.
  std::map<BrickKey, std::shared_ptr<const BrickStates>, BrickOrder> states;
  std::set<BrickKey, BrickOrder> to_code;
  for (const auto& [brick, own_changes] : changes_of) {
    const BrickStates& before = *previous.ready_brick(brick)->states;
    states[brick] = with_changes(before, own_changes);
    to_code.insert(brick);
    for (const VoxelChange& change : own_changes) {
      const VoxelState was = before.state(change.key);
      if (was == change.state) continue;
      // Leaps reach far; what lies at the edge of the known concerns direct neighbours.
      const bool moves_leaps = (was == VoxelState::free) != (change.state == VoxelState::free);
      const int code_reach = moves_leaps ? kCodeReach : 1;
      const auto low = [&](int key) { return std::max(key - code_reach, 0) >> kBrickBits; };
      const auto high = [&](int key) {
        return std::min((key + code_reach) >> kBrickBits, kBrickKeys - 1);
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
    const Block* shared_block = block_of(key);
    if (!own_blocks.contains(shared_block)) {
      auto copy = std::make_shared<Block>();
      copy->key = block_key(key);
      for (int slot = 0; slot < kBlockBricks; ++slot) copy->store(slot, shared_block->owned[slot]);
      own_blocks.insert(copy.get());
      own(std::move(copy));
    }
    const auto changed = states.find(key);
    block_of(key)->store(
        slot_of(key),
        make_brick(changed != states.end() ? changed->second : previous.ready_brick(key)->states,
                   neighbourhood_of(key, states_of)));
  }
}

std::vector<BrickKey> BrickTable::read_blocks() const {
  std::vector<BrickKey> blocks;
  for (const auto& block : owned_blocks_) {
    if (block != nullptr) blocks.push_back(block->key);
  }
  return blocks;
}

std::size_t BrickTable::memory_bytes() const {
  std::size_t bytes = blocks_.size() * (sizeof(blocks_[0]) + sizeof(owned_blocks_[0]));
  for (const auto& block : owned_blocks_) {
    if (block == nullptr) continue;
    bytes += sizeof(Block);
    for (const auto& ready : block->ready) {
      const Brick* brick = ready.load(std::memory_order_acquire);
      if (brick == nullptr || brick == unknown_brick().get()) continue;
      bytes +=
          sizeof(Brick) + sizeof(BrickStates) + brick->states->uncertainty.size() * sizeof(float);
    }
  }
  return bytes;
}

}  // namespace nbvopt::detail
