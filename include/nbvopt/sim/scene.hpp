// What there is to see: triangles that rays can be cast at.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

/// Where a ray meets a surface.
struct SurfaceHit {
  double distance_m;
  bool is_outside;  ///< seen from the side from which the triangle's corners turn left
};

/// A static world in the map frame, ready for casting (Embree). Const and safe to share between
/// threads.
class Scene {
 public:
  /// Throws InputError when the mesh holds no triangle, UsageError when an index is out of range or
  /// a vertex is not finite.
  explicit Scene(const TriangleMesh& mesh);
  ~Scene();

  /// The distance along each ray from the origin to the first surface, seen from either side; +inf
  /// where none is nearer than range_max_m. Directions have unit length; neighbours in order should
  /// be neighbours in direction. Casts on all cores; answers do not depend on how many.
  void first_hits(const Eigen::Vector3d& origin_map_m,
                  std::span<const Eigen::Vector3f> directions_map, float range_max_m,
                  std::span<float> distances_m) const;

  /// The first surface along one ray of unit length; none where none is nearer than range_max_m.
  std::optional<SurfaceHit> first_surface(const Eigen::Vector3d& origin_map_m,
                                          const Eigen::Vector3f& direction_map,
                                          float range_max_m) const;

  /// Whether any part of a surface lies within that distance of the point.
  bool has_surface_within(const Eigen::Vector3d& point_map_m, float distance_m) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace nbvopt
