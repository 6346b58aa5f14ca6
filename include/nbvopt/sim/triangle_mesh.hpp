// Triangles in one frame.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace nbvopt {

/// An indexed triangle mesh.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into vertices_m
};

}  // namespace nbvopt
