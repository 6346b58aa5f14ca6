#include "gain/cone_grid.hpp"

#include <algorithm>

#include "map/brick_table.hpp"
#include "map/map_access.hpp"

namespace nbvopt::detail {
namespace {

std::uint16_t clamped_key(int brick, int in_brick) {
  return static_cast<std::uint16_t>(std::clamp(brick * kBrickSize + in_brick, 0, 65535));
}

}  // namespace

ConeGrid::ConeGrid(const VoxelGrid& grid, const Eigen::Vector3d& min_lattice,
                   const Eigen::Vector3d& max_lattice) {
  const auto brick_of_place = [](double place) {
    return static_cast<int>(std::floor(place / kBrickSize));
  };
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  for (int a = 0; a < 3; ++a) {
    low[a] = brick_of_place(min_lattice[a] - kWindow);
    high[a] = brick_of_place(max_lattice[a] + kWindow);
    bricks_[a] = high[a] - low[a] + 1;
  }
  const BrickBox box{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  check_size(box);
  corner_ = Eigen::Vector3d(low[0], low[1], low[2]) * kBrickSize;
  grid.make_ready({{clamped_key(low[0], 0), clamped_key(low[1], 0), clamped_key(low[2], 0)},
                   {clamped_key(high[0], kBrickMask), clamped_key(high[1], kBrickMask),
                    clamped_key(high[2], kBrickMask)}});

  const auto voxels = static_cast<std::size_t>(box.size()) * kBrickVoxels;
  // A window's last row is read two bytes at a time.
  x_rows_.assign(voxels / 32 + 1, 0);
  y_rows_.assign(voxels / 32 + 1, 0);
  const std::ptrdiff_t x_row = 4L * bricks_[0];
  const std::ptrdiff_t y_row = 4L * bricks_[1];
  stride_ = {y_row * size(0), x_row * size(1), x_row};
  layer_stride_ = {y_row, x_row, x_row * size(1)};

  brick_.reserve(static_cast<std::size_t>(box.size()));
  box.for_each([&](BrickKey key) {
    const Brick* brick = MapAccess::table(grid).ready_brick(key);
    brick_.push_back(brick != nullptr ? brick : unknown_brick().get());
    if (brick_.back()->states->has_free) {
      add_brick(key.x - low[0], key.y - low[1], key.z - low[2], *brick_.back()->states);
    }
  });
}

void ConeGrid::add_brick(int bx, int by, int bz, const BrickStates& states) {
  const auto nx = static_cast<std::size_t>(size(0));
  const auto ny = static_cast<std::size_t>(size(1));
  for (int z = 0; z < kBrickSize; ++z) {
    const auto at_z = static_cast<std::size_t>(bz * kBrickSize + z);
    std::array<std::uint32_t, kBrickSize> slice{};
    for (int y = 0; y < kBrickSize; ++y) {
      slice[y] = states.free[y | z << kBrickBits];
      const std::size_t row = at_z * ny + static_cast<std::size_t>(by * kBrickSize + y);
      x_rows_[row * bricks_[0] + bx] = slice[y];
    }
    // The slice turned over its diagonal, by swapping ever smaller blocks.
    std::uint32_t mask = 0x0000FFFF;
    for (int block = 16; block != 0; block >>= 1, mask ^= mask << block) {
      for (int k = 0; k < kBrickSize; k = ((k | block) + 1) & ~block) {
        const std::uint32_t swap = ((slice[k] >> block) ^ slice[k | block]) & mask;
        slice[k] ^= swap << block;
        slice[k | block] ^= swap;
      }
    }
    for (int x = 0; x < kBrickSize; ++x) {
      const std::size_t row = at_z * nx + static_cast<std::size_t>(bx * kBrickSize + x);
      y_rows_[row * bricks_[1] + by] = slice[x];
    }
  }
}

}  // namespace nbvopt::detail
