// A brick's codes against what they mean, worked out voxel by voxel.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "map/brick.hpp"

namespace nbvopt::detail {
namespace {

constexpr std::array<int, 9> kRadii{0, 1, 2, 3, 4, 6, 8, 12, 16};

/// 27 bricks of random states, mostly free.
class Neighbourhood {
 public:
  Neighbourhood(unsigned seed, double non_free_share) {
    std::mt19937 random(seed);
    const std::vector<float> no_uncertainty(kBrickVoxels, kUnknownUncertainty);
    for (auto& states : states_) {
      states = std::make_unique<BrickStates>();
      for (int row = 0; row < kBrickRows; ++row) {
        for (int x = 0; x < kBrickSize; ++x) {
          const double draw = static_cast<double>(random()) / std::mt19937::max();
          if (draw >= non_free_share) {
            states->free[row] |= 1U << x;
          } else if (draw < non_free_share / 2) {
            states->occupied[row] |= 1U << x;
          }
        }
      }
      states->finish(no_uncertainty.data());
    }
  }

  BrickNeighbourhood bricks() const {
    BrickNeighbourhood all;
    std::transform(states_.begin(), states_.end(), all.begin(), [](auto& s) { return s.get(); });
    return all;
  }

  /// The state of a voxel counted from the middle brick's first.
  VoxelState state(int x, int y, int z) const {
    const auto brick = [](int v) { return (v + kBrickSize) / kBrickSize; };
    const VoxelKey key{static_cast<std::uint16_t>(x & kBrickMask),
                       static_cast<std::uint16_t>(y & kBrickMask),
                       static_cast<std::uint16_t>(z & kBrickMask)};
    return states_[brick(x) + 3 * brick(y) + 9 * brick(z)]->state(key);
  }

  /// Whether a voxel shares a face with one of this state.
  bool touches(int x, int y, int z, VoxelState wanted) const {
    return state(x - 1, y, z) == wanted || state(x + 1, y, z) == wanted ||
           state(x, y - 1, z) == wanted || state(x, y + 1, z) == wanted ||
           state(x, y, z - 1) == wanted || state(x, y, z + 1) == wanted;
  }

  /// The Chebyshev distance from a voxel to the nearest one that is not free, at most 17.
  int distance_to_non_free(int x, int y, int z) const {
    for (int r = 0; r <= kCodeReach; ++r) {
      for (int dz = -r; dz <= r; ++dz) {
        for (int dy = -r; dy <= r; ++dy) {
          for (int dx = -r; dx <= r; ++dx) {
            if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) != r) continue;
            if (state(x + dx, y + dy, z + dz) != VoxelState::free) return r;
          }
        }
      }
    }
    return kCodeReach + 1;
  }

 private:
  std::array<std::unique_ptr<BrickStates>, 27> states_;
};

class BrickCodes : public ::testing::TestWithParam<double> {};

TEST_P(BrickCodes, TellTheLargestListedCubeThatIsFreeAndTheEdgeOfTheKnown) {
  const Neighbourhood neighbourhood(7, GetParam());
  std::vector<std::uint8_t> code(kBrickVoxels);
  compute_codes(neighbourhood.bricks(), code.data());
  for (const int z : {0, 13, kBrickSize - 1}) {
    for (int y = 0; y < kBrickSize; ++y) {
      for (int x = 0; x < kBrickSize; ++x) {
        const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                           static_cast<std::uint16_t>(z)};
        const std::uint8_t got = code[code_index(key)];
        const VoxelState state = neighbourhood.state(x, y, z);
        if (state == VoxelState::unknown) {
          const bool beside = neighbourhood.touches(x, y, z, VoxelState::occupied);
          ASSERT_EQ(got, kUnknownCode | (beside ? kBesideSurfaceBit : 0));
        } else if (state == VoxelState::occupied) {
          ASSERT_EQ(got, kOccupiedCode);
        } else {
          const int free_radius = neighbourhood.distance_to_non_free(x, y, z) - 1;
          const int listed =
              *std::prev(std::upper_bound(kRadii.begin(), kRadii.end(), free_radius));
          const bool frontier = neighbourhood.touches(x, y, z, VoxelState::unknown);
          const bool beside = neighbourhood.touches(x, y, z, VoxelState::occupied);
          ASSERT_EQ(int{got}, (1 + listed) | (frontier ? kFrontierBit : 0) |
                                  (frontier && beside ? kFrontierBesideSurfaceBit : 0))
              << "at " << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Densities, BrickCodes,
                         ::testing::Values(0.3, 0.01, 0.001, 0.0001, 0.00002, 0.0));

}  // namespace
}  // namespace nbvopt::detail
