#include "sim/world/primitives.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "sim/world/append_mesh.hpp"

namespace nbvopt {

namespace {

using Vertices = std::vector<Eigen::Vector3f>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr int kSides = 64;
constexpr int kArcSteps = kSides / 4;  // of a profile's quarter circle

/// Turns a profile of points (radius, z), from the lower pole to the upper one, about z.
TriangleMesh turned(const std::vector<Eigen::Vector2d>& profile_m) {
  TriangleMesh mesh;
  for (const Eigen::Vector2d& point_m : profile_m) {
    for (int side = 0; side < kSides; ++side) {
      const double angle_rad = 2.0 * std::numbers::pi * side / kSides;
      mesh.vertices_m.emplace_back(Eigen::Vector3d(point_m.x() * std::cos(angle_rad),
                                                   point_m.x() * std::sin(angle_rad), point_m.y())
                                       .cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile_m.size(); ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t lower = ring * kSides;
      const std::uint32_t upper = lower + kSides;
      const std::uint32_t next = (side + 1) % kSides;
      mesh.triangles.push_back({lower + side, lower + next, upper + next});
      mesh.triangles.push_back({lower + side, upper + next, upper + side});
    }
  }
  // At a pole the ring is one point, where every other triangle has no area.
  return scaled(mesh, Eigen::Vector3d::Ones());
}

/// A quarter circle upwards from a latitude.
void append_arc(double latitude_rad, double radius_m, double centre_z_m,
                std::vector<Eigen::Vector2d>& profile_m) {
  for (int step = 0; step <= kArcSteps; ++step) {
    const double angle_rad = latitude_rad + 0.5 * std::numbers::pi * step / kArcSteps;
    const bool is_pole = std::abs(angle_rad) >= 0.5 * std::numbers::pi;
    profile_m.emplace_back(is_pole ? 0.0 : radius_m * std::cos(angle_rad),
                           centre_z_m + radius_m * std::sin(angle_rad));
  }
}

}  // namespace

TriangleMesh box_mesh(const Eigen::Vector3d& size_m) {
  static const TriangleMesh unit_box{Vertices{{-0.5F, -0.5F, -0.5F},
                                              {0.5F, -0.5F, -0.5F},
                                              {-0.5F, 0.5F, -0.5F},
                                              {0.5F, 0.5F, -0.5F},
                                              {-0.5F, -0.5F, 0.5F},
                                              {0.5F, -0.5F, 0.5F},
                                              {-0.5F, 0.5F, 0.5F},
                                              {0.5F, 0.5F, 0.5F}},
                                     Triangles{{0, 2, 1},
                                               {1, 2, 3},
                                               {4, 5, 6},
                                               {5, 7, 6},
                                               {0, 1, 4},
                                               {1, 5, 4},
                                               {2, 6, 3},
                                               {3, 6, 7},
                                               {0, 4, 2},
                                               {2, 4, 6},
                                               {1, 3, 5},
                                               {3, 7, 5}}};
  return scaled(unit_box, size_m);
}

TriangleMesh ellipsoid_mesh(const Eigen::Vector3d& radii_m) {
  return scaled(capsule_mesh(1.0, 0.0), radii_m);
}

TriangleMesh cylinder_mesh(double radius_m, double length_m) {
  const double half_m = 0.5 * length_m;
  return turned({{0.0, -half_m}, {radius_m, -half_m}, {radius_m, half_m}, {0.0, half_m}});
}

TriangleMesh cone_mesh(double radius_m, double length_m) {
  const double half_m = 0.5 * length_m;
  return turned({{0.0, -half_m}, {radius_m, -half_m}, {0.0, half_m}});
}

TriangleMesh capsule_mesh(double radius_m, double length_m) {
  std::vector<Eigen::Vector2d> profile_m;
  append_arc(-0.5 * std::numbers::pi, radius_m, -0.5 * length_m, profile_m);
  append_arc(0.0, radius_m, 0.5 * length_m, profile_m);
  return turned(profile_m);
}

TriangleMesh plane_mesh(const Eigen::Vector3d& normal, const Eigen::Vector2d& size_m) {
  static const TriangleMesh unit_square{
      Vertices{{-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {-0.5F, 0.5F, 0.0F}, {0.5F, 0.5F, 0.0F}},
      Triangles{{0, 1, 2}, {1, 3, 2}}};
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
  TriangleMesh plane;
  append_mesh(unit_square, Eigen::Affine3d(turn * Eigen::Scaling(size_m.x(), size_m.y(), 1.0)),
              plane);
  return plane;
}

}  // namespace nbvopt
