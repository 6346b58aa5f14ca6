// Boxes as triangles, to build test scenes from.
#pragma once

#include <Eigen/Core>
#include <array>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt::test {

/// Adds the twelve triangles of an axis-parallel box.
inline void add_box(TriangleMesh& mesh, const Eigen::Vector3d& min_m,
                    const Eigen::Vector3d& max_m) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    mesh.vertices_m.emplace_back(static_cast<float>(corner & 1U ? max_m.x() : min_m.x()),
                                 static_cast<float>(corner & 2U ? max_m.y() : min_m.y()),
                                 static_cast<float>(corner & 4U ? max_m.z() : min_m.z()));
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}

}  // namespace nbvopt::test
