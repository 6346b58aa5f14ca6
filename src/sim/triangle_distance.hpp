// How far a point is from a triangle.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace nbvopt {

/// The squared distance of a point from the segment between two others.
inline float squared_segment_distance(const Eigen::Vector3f& point, const Eigen::Vector3f& a,
                                      const Eigen::Vector3f& b) {
  const Eigen::Vector3f along = b - a;
  const float length_squared = along.squaredNorm();
  const float part = length_squared > 0.0F ? (point - a).dot(along) / length_squared : 0.0F;
  return (a + std::clamp(part, 0.0F, 1.0F) * along - point).squaredNorm();
}

/// The squared distance of a point from a triangle: from its plane where the point's foot lies
/// inside, else from the nearest edge. A triangle without area is its edges.
inline float squared_triangle_distance(const Eigen::Vector3f& point, const Eigen::Vector3f& a,
                                       const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  const auto is_inside_of = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    return (to - from).cross(point - from).dot(normal) >= 0.0F;
  };
  if (normal.squaredNorm() > 0.0F && is_inside_of(a, b) && is_inside_of(b, c) &&
      is_inside_of(c, a)) {
    const float height = (point - a).dot(normal.normalized());
    return height * height;
  }
  return std::min({squared_segment_distance(point, a, b), squared_segment_distance(point, b, c),
                   squared_segment_distance(point, c, a)});
}

}  // namespace nbvopt
