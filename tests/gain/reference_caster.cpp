#include "gain/reference_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nbvopt::test {
namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;
using Voxel = Eigen::Matrix<long, 3, 1>;

bool is_on_lattice(const Voxel& voxel) {
  return (voxel.array() >= 0).all() && (voxel.array() < 65536).all();
}

VoxelKey key_of(const Voxel& voxel) {
  return {static_cast<std::uint16_t>(voxel.x()), static_cast<std::uint16_t>(voxel.y()),
          static_cast<std::uint16_t>(voxel.z())};
}

/// The distance of a point, in lattice coordinates, to the nearest face across any axis but one.
double distance_to_faces(const Point& p, int except_axis) {
  double nearest = 1.0;
  for (int a = 0; a < 3; ++a) {
    if (a != except_axis) {
      nearest = std::min(nearest, static_cast<double>(std::abs(p[a] - std::round(p[a]))));
    }
  }
  return nearest;
}

/// The voxels along a ray, one after the other.
struct Walk {
  Point origin;
  Point direction;
  Voxel voxel = Voxel::Zero();
  Real entered = 0.0;
  Real exit = 0.0;
  int entered_axis = -1;
  int exit_axis = -1;

  Walk(const Point& from, const Point& along) : origin(from), direction(along) {
    for (int a = 0; a < 3; ++a) {
      voxel[a] = static_cast<long>(std::floor(origin[a]));
      // Down from a face, the ray never is in the voxel above it.
      if (direction[a] < 0.0 && origin[a] == std::floor(origin[a])) --voxel[a];
    }
    find_exit();
  }

  void find_exit() {
    exit = std::numeric_limits<Real>::infinity();
    for (int a = 0; a < 3; ++a) {
      if (direction[a] == 0.0) continue;
      const Real face = static_cast<Real>(direction[a] > 0.0 ? voxel[a] + 1 : voxel[a]);
      const Real distance = (face - origin[a]) / direction[a];
      if (distance < exit) {
        exit = distance;
        exit_axis = a;
      }
    }
  }

  void step() {
    entered = exit;
    entered_axis = exit_axis;
    voxel[exit_axis] += direction[exit_axis] > 0.0 ? 1 : -1;
    find_exit();
  }

  Face entered_face() const {
    constexpr Face kUp[] = {Face::plus_x, Face::plus_y, Face::plus_z};
    constexpr Face kDown[] = {Face::minus_x, Face::minus_y, Face::minus_z};
    return direction[entered_axis] > 0.0 ? kUp[entered_axis] : kDown[entered_axis];
  }
};

}  // namespace

ReferenceHit reference_cast(const VoxelGrid& grid, const RayBundle& rays, std::size_t ray,
                            double occupied_uncertainty) {
  const Real resolution_m = grid.lattice().resolution_m();
  const Real near = rays.range_min_m[ray] / resolution_m;
  const Real far = rays.range_max_m[ray] / resolution_m;
  Walk walk(grid.lattice().to_lattice(rays.T_map_rays.translation()).cast<Real>(),
            rays.T_map_rays.linear().cast<Real>() * Point(rays.x[ray], rays.y[ray], rays.z[ray]));
  const auto point_at = [&](Real distance) -> Point {
    return walk.origin + distance * walk.direction;
  };

  ReferenceHit hit;
  hit.distance_m = rays.range_max_m[ray];
  hit.clearance_voxels =
      std::min({distance_to_faces(walk.origin, -1), distance_to_faces(point_at(near), -1),
                distance_to_faces(point_at(far), -1)});
  for (;; walk.step()) {
    const VoxelState state =
        is_on_lattice(walk.voxel) ? grid.state(key_of(walk.voxel)) : VoxelState::unknown;
    const bool is_left_before_near = walk.exit <= near;
    if (is_left_before_near) {
      if (rays.near_blocking && state == VoxelState::occupied && walk.exit < near) {
        hit.kind = HitKind::blocked;
        return hit;
      }
    } else if (state != VoxelState::free) {
      const bool starts_inside = walk.entered <= near;
      hit.kind = state == VoxelState::occupied ? HitKind::occupied : HitKind::unknown;
      hit.face = starts_inside ? Face::inside : walk.entered_face();
      hit.voxel = key_of(walk.voxel);
      hit.distance_m =
          starts_inside ? rays.range_min_m[ray] : static_cast<double>(walk.entered * resolution_m);
      if (state == VoxelState::occupied) {
        hit.uncertainty = grid.carries_uncertainty() ? grid.uncertainty(hit.voxel)
                                                     : static_cast<float>(occupied_uncertainty);
      }
      return hit;
    }
    if (walk.exit >= far) return hit;
    hit.clearance_voxels =
        std::min(hit.clearance_voxels, distance_to_faces(point_at(walk.exit), walk.exit_axis));
  }
}

}  // namespace nbvopt::test
