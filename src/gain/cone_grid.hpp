// What cones are marched through: one bit a voxel that tells whether it is free, in rows along two
// axes, so that a window of 8 x 8 voxels of a layer across any axis is a few loads.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "map/brick.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt::detail {

/// A box of whole bricks of one version of a map, which must outlive it. Places count voxels from
/// the box's least corner; what lies off the lattice is unknown.
class ConeGrid {
 public:
  /// Windows are this many voxels wide, and none may reach out of the box.
  static constexpr int kWindow = 8;

  /// Makes the bricks between these lattice coordinates ready, and a window's width beyond. Throws
  /// InputError when the box is absurdly large.
  ConeGrid(const VoxelGrid& grid, const Eigen::Vector3d& min_lattice,
           const Eigen::Vector3d& max_lattice);

  /// The lattice coordinates of the least corner.
  const Eigen::Vector3d& corner() const { return corner_; }
  int size(int axis) const { return kBrickSize * bricks_[axis]; }

  /// The axes of a layer across an axis: its rows lie along the first.
  static constexpr int row_axis(int across) { return across == 0 ? 1 : 0; }
  static constexpr int column_axis(int across) { return across == 2 ? 1 : 2; }

  /// Which voxels of a window are free: row r, bit b at 8 r + b; `rows` of them, the rest is 0.
  std::uint64_t free_window(int across, int layer, int row_place, int column_place,
                            int rows) const {
    const std::uint8_t* row = layer_rows(across, layer) + stride(across) * column_place;
    std::uint64_t window = 0;
    for (int r = 0; r < rows; ++r, row += stride(across)) {
      std::uint16_t bits = 0;
      std::memcpy(&bits, row + (row_place >> 3), sizeof bits);
      window |= static_cast<std::uint64_t>((bits >> (row_place & 7)) & 0xFFU) << (8 * r);
    }
    return window;
  }

  /// The code of a voxel, as rays read it.
  std::uint8_t code(const std::array<int, 3>& place) const {
    return brick(place).code[code_index(key_in_brick(place))];
  }

  bool is_occupied(const std::array<int, 3>& place) const {
    return brick(place).states->state(key_in_brick(place)) == VoxelState::occupied;
  }

  /// u of an occupied voxel, `none_stored` where the map stores none.
  float uncertainty_of_occupied(const std::array<int, 3>& place, float none_stored) const {
    return brick(place).states->uncertainty_of_occupied(key_in_brick(place), none_stored);
  }

 private:
  static VoxelKey key_in_brick(const std::array<int, 3>& place) {
    return {static_cast<std::uint16_t>(place[0]), static_cast<std::uint16_t>(place[1]),
            static_cast<std::uint16_t>(place[2])};
  }
  const Brick& brick(const std::array<int, 3>& place) const {
    return *brick_[static_cast<std::size_t>(
        (place[0] >> kBrickBits) +
        bricks_[0] * ((place[1] >> kBrickBits) + bricks_[1] * (place[2] >> kBrickBits)))];
  }

  /// Bytes from a row of a layer to the next.
  std::ptrdiff_t stride(int across) const { return stride_[across]; }
  const std::uint8_t* layer_rows(int across, int layer) const {
    const auto& rows = across == 0 ? y_rows_ : x_rows_;
    return reinterpret_cast<const std::uint8_t*>(rows.data()) + layer_stride_[across] * layer;
  }

  void add_brick(int bx, int by, int bz, const BrickStates& states);

  Eigen::Vector3d corner_;
  std::array<int, 3> bricks_{};
  std::vector<const Brick*> brick_;
  std::vector<std::uint32_t> x_rows_;  ///< rows along x, y running fastest
  std::vector<std::uint32_t> y_rows_;  ///< rows along y, x running fastest
  std::array<std::ptrdiff_t, 3> stride_{}, layer_stride_{};
};

}  // namespace nbvopt::detail
