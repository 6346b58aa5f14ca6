#include "sim/world/append_mesh.hpp"

#include <limits>
#include <utility>

namespace nbvopt {

namespace {

/// Whether a ray can meet the triangle. NaN and infinity compare as false.
bool has_area(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector3d ab = (b - a).cast<double>();
  const Eigen::Vector3d ac = (c - a).cast<double>();
  const double doubled_area_m2 = ab.cross(ac).norm();
  return doubled_area_m2 > 0.0 && doubled_area_m2 < std::numeric_limits<double>::infinity();
}

}  // namespace

void append_mesh(const TriangleMesh& mesh_part, const Eigen::Affine3d& T_whole_part,
                 TriangleMesh& mesh_whole) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<Eigen::Vector3f> vertices_whole_m;
  vertices_whole_m.reserve(mesh_part.vertices_m.size());
  for (const Eigen::Vector3f& vertex_part_m : mesh_part.vertices_m) {
    vertices_whole_m.emplace_back((T_whole_part * vertex_part_m.cast<double>()).cast<float>());
  }
  const bool is_mirrored = T_whole_part.linear().determinant() < 0.0;
  std::vector<std::uint32_t> indices_whole(vertices_whole_m.size(), kUnused);
  for (auto [a, b, c] : mesh_part.triangles) {
    if (!has_area(vertices_whole_m[a], vertices_whole_m[b], vertices_whole_m[c])) continue;
    if (is_mirrored) std::swap(b, c);
    for (const std::uint32_t index : {a, b, c}) {
      if (indices_whole[index] != kUnused) continue;
      indices_whole[index] = static_cast<std::uint32_t>(mesh_whole.vertices_m.size());
      mesh_whole.vertices_m.push_back(vertices_whole_m[index]);
    }
    mesh_whole.triangles.push_back({indices_whole[a], indices_whole[b], indices_whole[c]});
  }
}

TriangleMesh scaled(const TriangleMesh& mesh, const Eigen::Vector3d& factors) {
  TriangleMesh stretched;
  append_mesh(mesh, Eigen::Affine3d(Eigen::Scaling(factors)), stretched);
  return stretched;
}

}  // namespace nbvopt
