// One ray in double precision: the plain statement of how a ray is walked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gain/ray_walk.hpp"

namespace nbvopt::detail {

/// One ray in mirrored lattice coordinates around the origin's voxel.
class ScalarRay {
 public:
  ScalarRay(const RayWalk& walk, const Eigen::Vector3d& direction_map) : walk_(walk) {
    for (int a = 0; a < 3; ++a) {
      const bool down = direction_map[a] < 0.0;
      mirror_[a] = down ? -1 : 0;
      origin_[a] = down ? -walk.origin_in_voxel[a] : walk.origin_in_voxel[a];
      direction_[a] = std::max(std::abs(direction_map[a]), kSmallestDirection);
    }
  }

  void start_at(double distance) {
    for (int a = 0; a < 3; ++a) {
      voxel_[a] = static_cast<int>(std::floor(origin_[a] + distance * direction_[a]));
    }
    entered_axis_ = -1;
  }

  std::uint8_t code() const {
    return walk_.bricks.code[walk_.bricks.place_of(brick_at(lattice_key()))][code_index(key())];
  }

  /// Where the ray leaves the cube of this radius around its voxel; remembers the axis.
  double exit_of_cube(int radius) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
      const double t = (voxel_[a] + radius + 1 - origin_[a]) / direction_[a];
      if (t < nearest) {
        nearest = t;
        exit_axis_ = a;
      }
    }
    return nearest;
  }

  /// Enters the voxel behind the cube's face that exit_of_cube() found.
  void leap(int radius, double distance) {
    for (int a = 0; a < 3; ++a) {
      const int last = voxel_[a] + radius;
      // Rounding must not take the ray out of the cube by any other face.
      voxel_[a] =
          a == exit_axis_
              ? last + 1
              : std::clamp(static_cast<int>(std::floor(origin_[a] + distance * direction_[a])),
                           voxel_[a], last);
    }
    entered_axis_ = exit_axis_;
  }

  VoxelKey key() const {
    const Eigen::Vector3i k = lattice_key();
    return {static_cast<std::uint16_t>(k.x()), static_cast<std::uint16_t>(k.y()),
            static_cast<std::uint16_t>(k.z())};
  }

  Face face() const {
    if (entered_axis_ < 0) return Face::inside;
    return static_cast<Face>(1 + 2 * entered_axis_ - mirror_[entered_axis_]);
  }

  double entry_distance_m(double range_min_m) const {
    if (entered_axis_ < 0) return range_min_m;
    const int a = entered_axis_;
    return std::max(range_min_m, (voxel_[a] - origin_[a]) * walk_.resolution_m / direction_[a]);
  }

  /// Whether an occupied voxel, left before `end`, stands between the origin and there.
  bool is_blocked_before(double end) {
    start_at(0.0);
    for (;;) {
      const std::uint8_t c = code();
      const int radius = is_free_code(c) ? leap_radius(c) : 0;
      const double t = exit_of_cube(radius);
      if (t >= end) return false;
      if (c == kOccupiedCode) return true;
      leap(radius, t);
    }
  }

 private:
  /// The voxel's key, which may lie off the lattice.
  Eigen::Vector3i lattice_key() const {
    return {(voxel_[0] ^ mirror_[0]) + walk_.origin_key[0],
            (voxel_[1] ^ mirror_[1]) + walk_.origin_key[1],
            (voxel_[2] ^ mirror_[2]) + walk_.origin_key[2]};
  }

  const RayWalk& walk_;
  std::array<double, 3> origin_{};
  std::array<double, 3> direction_{};
  std::array<int, 3> mirror_{};
  std::array<int, 3> voxel_{};
  int entered_axis_ = -1;
  int exit_axis_ = 0;
};

}  // namespace nbvopt::detail
