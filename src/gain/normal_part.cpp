#include "gain/normal_part.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt::detail {
namespace {

/// The normal of the face by which a ray enters a voxel; zero where it starts inside.
Eigen::Vector3d face_normal(Face face) {
  if (face == Face::inside) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d::Unit(axis_of(face));
}

/// A voxel and its 26 neighbours, as far as the lattice goes.
KeyBox neighbourhood(VoxelKey voxel) {
  const auto before = [](std::uint16_t key) {
    return static_cast<std::uint16_t>(key > 0 ? key - 1 : key);
  };
  const auto after = [](std::uint16_t key) {
    return static_cast<std::uint16_t>(key < std::numeric_limits<std::uint16_t>::max() ? key + 1
                                                                                      : key);
  };
  return {{before(voxel.x), before(voxel.y), before(voxel.z)},
          {after(voxel.x), after(voxel.y), after(voxel.z)}};
}

void make_neighbours_ready(const VoxelGrid& grid, const RayHits& hits) {
  std::optional<KeyBox> all;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits.kind[i] != HitKind::occupied) continue;
    const KeyBox one = neighbourhood(hits.voxel[i]);
    if (!all) all = one;
    all->min = {std::min(all->min.x, one.min.x), std::min(all->min.y, one.min.y),
                std::min(all->min.z, one.min.z)};
    all->max = {std::max(all->max.x, one.max.x), std::max(all->max.y, one.max.y),
                std::max(all->max.z, one.max.z)};
  }
  if (all) grid.make_ready(*all);
}

}  // namespace

Eigen::Vector3d surface_normal(const VoxelGrid& grid, VoxelKey voxel) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const KeyBox box = neighbourhood(voxel);
  for (int z = box.min.z; z <= box.max.z; ++z) {
    for (int y = box.min.y; y <= box.max.y; ++y) {
      for (int x = box.min.x; x <= box.max.x; ++x) {
        const VoxelKey neighbour{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                 static_cast<std::uint16_t>(z)};
        if (neighbour == voxel || grid.state(neighbour) != VoxelState::free) continue;
        const Eigen::Vector3d way(x - voxel.x, y - voxel.y, z - voxel.z);
        sum += way / way.squaredNorm();
      }
    }
  }
  constexpr double kCancelledOut = 0.1;
  const double length = sum.norm();
  return length > kCancelledOut ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::Zero();
}

double unknown_without_normal_part(double weight) {
  return kUnknownUncertainty - weight * kUnseenNormalUncertainty;
}

void take_normal_part(const VoxelGrid& grid, double weight, RayHits& hits) {
  if (weight == 0.0) return;
  make_neighbours_ready(grid, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits.kind[i] < HitKind::unknown) continue;
    double u_normal = kUnseenNormalUncertainty;
    if (hits.kind[i] == HitKind::occupied) {
      Eigen::Vector3d normal = surface_normal(grid, hits.voxel[i]);
      if (normal.isZero()) normal = face_normal(hits.face[i]);
      u_normal = UncertaintyModel::normal_uncertainty(
          normal, {hits.direction_x[i], hits.direction_y[i], hits.direction_z[i]});
    }
    hits.uncertainty[i] -= static_cast<float>(weight * u_normal);
  }
}

}  // namespace nbvopt::detail
