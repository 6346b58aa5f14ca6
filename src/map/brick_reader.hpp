// Reads bricks from the octree.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "map/brick.hpp"

namespace nbvopt {
class UncertaintyOcTree;
}

namespace nbvopt::detail {

/// Bricks come in blocks of 16 x 16 x 16; a block's address is its bricks' keys divided by 16.
inline constexpr int kBlockBits = 4;

/// How many bricks the tree knows anything of; a pruned leaf counts as the bricks that it covers.
std::uint64_t count_known_bricks(const UncertaintyOcTree& tree);

/// The blocks in which the tree knows anything, each once.
std::vector<BrickKey> known_blocks(const UncertaintyOcTree& tree);

/// The octants of a brick, one bit each: bit x + 2 y + 4 z, 1 being the upper half along an axis.
using Octants = std::uint8_t;
inline constexpr Octants kAllOctants = 0xFF;

/// The states of one brick, of which other octants may be left
/// out; null when nothing of it is known.
std::shared_ptr<const BrickStates> read_brick(const UncertaintyOcTree& tree, BrickKey brick,
                                              Octants octants);

}  // namespace nbvopt::detail
