// Where the bricks of a grid are.
//
// The table is a box of blocks of 16 x 16 x 16 bricks; blocks in which the map knows nothing do
// not exist, so a stray voxel far away costs one block and no more.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "map/brick.hpp"
#include "map/brick_reader.hpp"

namespace nbvopt::detail {

/// A closed box of bricks.
struct BrickBox {
  BrickKey min;
  BrickKey max;

  /// Not an integer, so that no box overflows it.
  double size() const {
    return (max.x - min.x + 1.0) * (max.y - min.y + 1.0) * (max.z - min.z + 1.0);
  }

  bool contains(BrickKey key) const {
    return key.x >= min.x && key.x <= max.x && key.y >= min.y && key.y <= max.y && key.z >= min.z &&
           key.z <= max.z;
  }

  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (int z = min.z; z <= max.z; ++z) {
      for (int y = min.y; y <= max.y; ++y) {
        for (int x = min.x; x <= max.x; ++x) visit(BrickKey{x, y, z});
      }
    }
  }
};

/// Throws InputError when the box is absurdly large.
void check_size(const BrickBox& box);

/// The bricks of a box. Throws InputError when it is absurdly large.
std::vector<BrickKey> brick_keys_of(const BrickBox& box);

/// What a brick spans, in lattice coordinates.
inline Eigen::AlignedBox3d lattice_box(BrickKey key) {
  const Eigen::Vector3d min = kBrickSize * Eigen::Vector3d(key.x, key.y, key.z);
  return {min, min + Eigen::Vector3d::Constant(kBrickSize)};
}

inline BrickBox bricks_of(const KeyBox& box) { return {brick_of(box.min), brick_of(box.max)}; }

class BrickTable {
 public:
  /// A table that reads bricks from the tree when they are first asked for.
  explicit BrickTable(const UncertaintyOcTree& tree);

  /// A table of the same bricks, with the changes. Requires read_all() to have been called.
  BrickTable(const BrickTable& previous, std::span<const VoxelChange> changes);

  /// Reads what is left, and lets go of the tree. Thread-safe.
  void read_all();
  bool is_whole() const { return tree_ == nullptr; }

  /// Makes bricks ready. Thread-safe.
  void make_ready(const std::vector<BrickKey>& wanted) const;

  /// A brick that was made ready, null if it was not. Lock-free.
  const Brick* ready_brick(BrickKey key) const {
    const Block* block = block_of(key);
    return block == nullptr ? nullptr : block->ready[slot_of(key)].load(std::memory_order_acquire);
  }

  std::size_t memory_bytes() const;

  /// The blocks of which any brick was read, each once. Thread-safe once the table is whole.
  std::vector<BrickKey> read_blocks() const;

 private:
  static constexpr int kBlockSize = 1 << kBlockBits;
  static constexpr int kBlockBricks = kBlockSize * kBlockSize * kBlockSize;

  struct Block {
    BrickKey key;
    std::array<std::atomic<const Brick*>, kBlockBricks> ready{};
    std::array<std::shared_ptr<const Brick>, kBlockBricks> owned;  ///< shared by grid versions

    void store(int slot, std::shared_ptr<const Brick> brick) {
      owned[slot] = std::move(brick);
      ready[slot].store(owned[slot].get(), std::memory_order_release);
    }
  };

  static constexpr BrickKey block_key(BrickKey brick) {
    return {brick.x >> kBlockBits, brick.y >> kBlockBits, brick.z >> kBlockBits};
  }
  static constexpr int slot_of(BrickKey brick) {
    constexpr int kMask = kBlockSize - 1;
    return (brick.x & kMask) | (brick.y & kMask) << kBlockBits |
           (brick.z & kMask) << (2 * kBlockBits);
  }

  /// The place of a block in blocks_, or -1 outside the box of blocks.
  int place_of(BrickKey block) const {
    const int x = block.x - min_.x;
    const int y = block.y - min_.y;
    const int z = block.z - min_.z;
    const bool inside = static_cast<unsigned>(x) < static_cast<unsigned>(size_.x) &&
                        static_cast<unsigned>(y) < static_cast<unsigned>(size_.y) &&
                        static_cast<unsigned>(z) < static_cast<unsigned>(size_.z);
    return inside ? x + size_.x * (y + size_.y * z) : -1;
  }
  /// The block of a brick; null while none of its bricks was read.
  Block* block_of(BrickKey brick) const {
    const int place = place_of(block_key(brick));
    return place < 0 ? unknown_block_ : blocks_[place].load(std::memory_order_acquire);
  }

  /// The block in which nothing is known, shared by all tables.
  static Block* unknown_block();

  /// Lays out the table over the given blocks, all unknown.
  void lay_out(const std::vector<BrickKey>& blocks);

  /// Puts a block in its place.
  void own(std::shared_ptr<Block> block) const;

  /// The states of a brick that is ready or has been read.
  const std::shared_ptr<const BrickStates>& states_of(BrickKey key) const;

  std::atomic<const UncertaintyOcTree*> tree_ = nullptr;  ///< null once everything is read
  Block* unknown_block_ = unknown_block();
  BrickKey min_;
  BrickKey size_{0, 0, 0};
  // A block is made when the first of its bricks is read, under mutex_; then it stays.
  mutable std::vector<std::atomic<Block*>> blocks_;
  /// The same; shared with other versions of the grid. A version writes only blocks of its own.
  mutable std::vector<std::shared_ptr<Block>> owned_blocks_;

  mutable std::mutex mutex_;
  /// States read from the tree, ahead of the codes, which need the neighbours' states too, as far
  /// as codes reach.
  struct ReadStates {
    std::shared_ptr<const BrickStates> states;
    Octants octants = 0;  ///< that were read
  };
  mutable std::unordered_map<std::uint64_t, ReadStates> states_;
};

}  // namespace nbvopt::detail
