#include "gain/surface_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

namespace nbvopt::detail {
namespace {

/// A cube of squared distances, x running fastest.
class DistanceCube {
 public:
  DistanceCube(int size, int reach) : size_(size), reach_(reach) {
    values_.assign(static_cast<std::size_t>(size) * size * size, kNone);
  }

  static constexpr int kNone = std::numeric_limits<int>::max() / 2;

  int& at(int x, int y, int z) { return values_[x + size_ * (y + size_ * z)]; }

  /// Takes from zeros at surfaces to squared distances, an axis after the other.
  void spread() {
    for (int axis = 0; axis < 3; ++axis) spread_along(axis);
  }

 private:
  void spread_along(int axis) {
    const int step = axis == 0 ? 1 : axis == 1 ? size_ : size_ * size_;
    std::vector<int> line(size_);
    for (int b = 0; b < size_; ++b) {
      for (int a = 0; a < size_; ++a) {
        int* first = axis == 0 ? &at(0, a, b) : axis == 1 ? &at(a, 0, b) : &at(a, b, 0);
        bool is_far = true;
        for (int i = 0; i < size_; ++i) {
          line[i] = first[i * step];
          is_far = is_far && line[i] == kNone;
        }
        if (is_far) continue;
        for (int i = 0; i < size_; ++i) {
          int best = line[i];
          for (int j = std::max(0, i - reach_); j <= std::min(size_ - 1, i + reach_); ++j) {
            best = std::min(best, line[j] + (i - j) * (i - j));
          }
          first[i * step] = best;
        }
      }
    }
  }

  int size_;
  int reach_;
  std::vector<int> values_;
};

}  // namespace

SurfaceDistances::SurfaceDistances(std::shared_ptr<const VoxelGrid> grid, double reach_m)
    : grid_(std::move(grid)),
      // The share keeps 0.3 / 0.1 from being a voxel less by rounding.
      reach_(static_cast<int>(std::clamp(
          std::floor(reach_m / grid_->lattice().resolution_m() + 1e-9), 1.0, double{kMostReach}))) {
}

double SurfaceDistances::voxels_to_surface(VoxelKey key) const {
  const std::uint16_t squared = distances_of(brick_of(key))[index_of(key)];
  return squared == kFar ? std::numeric_limits<double>::infinity() : std::sqrt(squared);
}

const SurfaceDistances::BrickDistances& SurfaceDistances::distances_of(BrickKey brick) const {
  const std::uint64_t place =
      packed({static_cast<std::uint16_t>(brick.x), static_cast<std::uint16_t>(brick.y),
              static_cast<std::uint16_t>(brick.z)});
  {
    const std::shared_lock lock(mutex_);
    const auto known = bricks_.find(place);
    if (known != bricks_.end()) return known->second;
  }
  BrickDistances distances = compute(brick);
  const std::scoped_lock lock(mutex_);
  return bricks_.emplace(place, std::move(distances)).first->second;
}

SurfaceDistances::BrickDistances SurfaceDistances::compute(BrickKey brick) const {
  const auto first_key = [](int b) { return b << kBrickBits; };
  const auto clamped = [](int key) {
    return static_cast<std::uint16_t>(std::clamp(key, 0, 65535));
  };
  const int x0 = first_key(brick.x) - reach_;
  const int y0 = first_key(brick.y) - reach_;
  const int z0 = first_key(brick.z) - reach_;
  const int size = kBrickSize + 2 * reach_;
  const KeyBox box{{clamped(x0), clamped(y0), clamped(z0)},
                   {clamped(x0 + size - 1), clamped(y0 + size - 1), clamped(z0 + size - 1)}};
  grid_->make_ready(box);
  BrickDistances distances(kBrickVoxels, kFar);
  if (!grid_->any_occupied(box)) return distances;

  DistanceCube cube(size, reach_);
  for (int z = box.min.z; z <= box.max.z; ++z) {
    for (int y = box.min.y; y <= box.max.y; ++y) {
      for (int x = box.min.x; x <= box.max.x; ++x) {
        const VoxelKey key{clamped(x), clamped(y), clamped(z)};
        if (grid_->state(key) == VoxelState::occupied) cube.at(x - x0, y - y0, z - z0) = 0;
      }
    }
  }
  cube.spread();
  for (int z = 0; z < kBrickSize; ++z) {
    for (int y = 0; y < kBrickSize; ++y) {
      for (int x = 0; x < kBrickSize; ++x) {
        const int squared = cube.at(x + reach_, y + reach_, z + reach_);
        if (squared > reach_ * reach_) continue;
        distances[x | (y | z << kBrickBits) << kBrickBits] = static_cast<std::uint16_t>(squared);
      }
    }
  }
  return distances;
}

}  // namespace nbvopt::detail
