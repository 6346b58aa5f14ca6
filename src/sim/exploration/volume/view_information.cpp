#include "sim/exploration/volume/view_information.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "map/brick_table.hpp"
#include "map/map_access.hpp"

namespace nbvopt {
namespace {

using detail::kBrickBits;
using detail::kBrickSize;

/// Directions shorter than this along an axis never reach the next voxel in range.
constexpr double kSmallestDirection = 1e-12;

/// The voxels in a box of whole bricks as bits, a word a row of a brick: those that are occupied in
/// its lower half, those that are unknown and were not counted yet in its upper half.
class Window {
 public:
  Window(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_map_m,
         std::vector<std::uint64_t>& words)
      : bricks_(detail::bricks_of(
            {grid.lattice().key(box_map_m.min()), grid.lattice().key(box_map_m.max())})),
        min_(bricks_.min.x * kBrickSize, bricks_.min.y * kBrickSize, bricks_.min.z * kBrickSize),
        size_(Eigen::Vector3i(bricks_.max.x + 1, bricks_.max.y + 1, bricks_.max.z + 1) *
                  kBrickSize -
              min_),
        words_(words) {
    words_.resize(static_cast<std::size_t>(size_.x() / kBrickSize) *
                  static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(size_.z()));
    const detail::BrickTable& table = detail::MapAccess::table(grid);
    bricks_.for_each([&](detail::BrickKey key) { read(key, *table.ready_brick(key)->states); });
  }

  /// The key of its least corner.
  const Eigen::Vector3i& min() const { return min_; }

  /// Where the row of words along x is that holds (0, y, z), counted from the least corner.
  std::ptrdiff_t row(int y, int z) const { return y * row_step() + z * layer_step(); }
  std::ptrdiff_t row_step() const { return size_.x() / kBrickSize; }
  std::ptrdiff_t layer_step() const { return row_step() * size_.y(); }

  /// The word of a voxel in that row.
  std::uint64_t& word(std::ptrdiff_t row, int x) {
    return words_[static_cast<std::size_t>(row + (x >> kBrickBits))];
  }

 private:
  void read(detail::BrickKey key, const detail::BrickStates& states) {
    const Eigen::Vector3i corner = Eigen::Vector3i(key.x, key.y, key.z) * kBrickSize - min_;
    for (int z = 0; z < kBrickSize; ++z) {
      for (int y = 0; y < kBrickSize; ++y) {
        const auto states_row = static_cast<std::size_t>(y | z << kBrickBits);
        const std::uint32_t occupied = states.occupied[states_row];
        const std::uint32_t unknown = ~(occupied | states.free[states_row]);
        word(this->row(corner.y() + y, corner.z() + z), corner.x()) =
            std::uint64_t{occupied} | std::uint64_t{unknown} << kBrickSize;
      }
    }
  }

  detail::BrickBox bricks_;
  Eigen::Vector3i min_;
  Eigen::Vector3i size_;
  std::vector<std::uint64_t>& words_;
};

/// Walks along a ray from voxel to voxel (J. Amanatides, A. Woo, 1987) and takes the unknown voxels
/// out of the window, which holds the whole ray. Origin and range in voxels, the origin from the
/// window's least corner. Returns how many there were.
std::uint64_t take_unknown(Window& window, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& direction, double range) {
  const Eigen::Array3i voxel = origin.array().floor().cast<int>();
  const Eigen::Array3i step = (direction.array() > 0.0).select(Eigen::Array3i::Ones(), -1);
  const Eigen::Array3d spacing = direction.array().abs().max(kSmallestDirection).inverse();
  const Eigen::Array3d in_voxel = origin.array() - voxel.cast<double>();
  // Where the ray enters the next voxel on each axis.
  Eigen::Array3d crossing = spacing * (direction.array() > 0.0).select(1.0 - in_voxel, in_voxel);
  const std::ptrdiff_t row_step_y = step.y() * window.row_step();
  const std::ptrdiff_t row_step_z = step.z() * window.layer_step();
  int x = voxel.x();
  std::ptrdiff_t row = window.row(voxel.y(), voxel.z());
  double crossing_x = crossing.x();
  double crossing_y = crossing.y();
  double crossing_z = crossing.z();
  std::uint64_t taken = 0;
  for (;;) {
    std::uint64_t& word = window.word(row, x);
    const int bit = x & (kBrickSize - 1);
    if ((word >> bit & 1U) != 0) return taken;
    taken += word >> (kBrickSize + bit) & 1U;
    word &= ~(std::uint64_t{1} << (kBrickSize + bit));
    const double next = std::min(crossing_x, std::min(crossing_y, crossing_z));
    if (next > range) return taken;
    // Without a branch, since which axis is next is as hard to predict as a die.
    const bool is_x = crossing_x == next;
    const bool is_y = crossing_y == next && !is_x;
    const bool is_z = !is_x && !is_y;
    x += is_x ? step.x() : 0;
    row += (is_y ? row_step_y : 0) + (is_z ? row_step_z : 0);
    crossing_x += is_x ? spacing.x() : 0.0;
    crossing_y += is_y ? spacing.y() : 0.0;
    crossing_z += is_z ? spacing.z() : 0.0;
  }
}

/// The range, cut to what lies on the lattice. All in voxels.
double range_on_lattice(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                        double range) {
  constexpr double kLastVoxel = 65535.0;
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0.0) continue;
    const double face = direction[a] > 0.0 ? kLastVoxel : 1.0;
    range = std::min(range, (face - origin[a]) / direction[a]);
  }
  return range;
}

}  // namespace

double ViewInformation::volume_m3(const VoxelGrid& grid, const Transform& T_map_sensor) {
  const CameraRays& rays = camera_.rays();
  const Eigen::Matrix3d& R_map_sensor = T_map_sensor.linear();
  Eigen::AlignedBox3d box_map_m(T_map_sensor.translation());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    box_map_m.extend(T_map_sensor * (rays.range_max_m[i] * rays.direction(i)));
  }
  const Lattice& lattice = grid.lattice();
  const Eigen::Vector3d voxel_m = Eigen::Vector3d::Constant(lattice.resolution_m());
  // Rounding may take a ray's end into the next voxel.
  Window window(grid, {box_map_m.min() - voxel_m, box_map_m.max() + voxel_m}, window_);
  const Eigen::Vector3d origin = lattice.to_lattice(T_map_sensor.translation());
  std::uint64_t voxels = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d direction = R_map_sensor * rays.direction(i);
    voxels += take_unknown(
        window, origin - window.min().cast<double>(), direction,
        range_on_lattice(origin, direction, rays.range_max_m[i] / lattice.resolution_m()));
  }
  return static_cast<double>(voxels) * voxel_m.prod();
}

}  // namespace nbvopt
