#include "map/scan_normals.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace nbvopt {
namespace {

/// Neighbours that differ by more are not on one surface, or on one that is hardly seen.
constexpr float kSteepest = 10.0F;  // tan of the angle of incidence

/// Points by the pixel of a depth image that they are seen in.
class PointImage {
 public:
  PointImage(std::span<const Eigen::Vector3f> points_m, const SensorOptions& sensor, int width,
             int height)
      : points_m_(points_m),
        sensor_(sensor),
        width_(width),
        height_(height),
        indices_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kNone),
        largest_step_(kSteepest *
                      static_cast<float>(2.0 * sensor.half_fov_horizontal_rad / width)) {
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      if (const auto pixel = pixel_of(points_m[i])) {
        indices_[place_of(*pixel)] = static_cast<std::uint32_t>(i);
      }
    }
  }

  /// Zero where there are no neighbours.
  Eigen::Vector3f normal(const Eigen::Vector3f& point_m) const {
    const auto pixel = pixel_of(point_m);
    if (!pixel) return Eigen::Vector3f::Zero();
    const Eigen::Vector3f right = tangent(point_m, *pixel, {1, 0});
    const Eigen::Vector3f down = tangent(point_m, *pixel, {0, 1});
    const Eigen::Vector3f across = down.cross(right);
    if (across.isZero(0.0F)) return Eigen::Vector3f::Zero();
    return across.dot(point_m) > 0.0F ? -across.normalized() : across.normalized();
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::optional<Eigen::Vector2i> pixel_of(const Eigen::Vector3f& point_m) const {
    if (!point_m.allFinite() || !(point_m.z() > 0.0F)) return std::nullopt;
    const double x = point_m.x() / point_m.z();
    const double y = point_m.y() / point_m.z();
    const double column = place(x, sensor_.half_fov_horizontal_rad, width_);
    const double row = place(y, sensor_.half_fov_vertical_rad, height_);
    if (!(column >= 0.0 && column < width_ && row >= 0.0 && row < height_)) return std::nullopt;
    return Eigen::Vector2i(static_cast<int>(column), static_cast<int>(row));
  }

  /// Where a ray of this tangent falls among so many pixels, each one wide.
  double place(double tangent, double half_fov_rad, int pixels) const {
    if (sensor_.ray_pattern == RayPattern::equal_angles) {  // from edge to edge
      return 0.5 * (1.0 + std::atan(tangent) / half_fov_rad) * (pixels - 1) + 0.5;
    }
    return 0.5 * (1.0 + tangent / std::tan(half_fov_rad)) * pixels;
  }

  /// Row by row.
  std::size_t place_of(const Eigen::Vector2i& pixel) const {
    return static_cast<std::size_t>(pixel.y()) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(pixel.x());
  }

  /// The neighbour that is on one surface with the point, or the point.
  const Eigen::Vector3f& neighbour(const Eigen::Vector3f& point_m,
                                   const Eigen::Vector2i& pixel) const {
    if (pixel.x() < 0 || pixel.x() >= width_ || pixel.y() < 0 || pixel.y() >= height_) {
      return point_m;
    }
    const std::uint32_t i = indices_[place_of(pixel)];
    if (i == kNone) return point_m;
    const float range_m = point_m.norm();
    const bool is_near = std::abs(points_m_[i].norm() - range_m) <= largest_step_ * range_m;
    return is_near ? points_m_[i] : point_m;
  }

  Eigen::Vector3f tangent(const Eigen::Vector3f& point_m, const Eigen::Vector2i& pixel,
                          const Eigen::Vector2i& way) const {
    return neighbour(point_m, pixel + way) - neighbour(point_m, pixel - way);
  }

  std::span<const Eigen::Vector3f> points_m_;
  const SensorOptions& sensor_;
  int width_;
  int height_;
  std::vector<std::uint32_t> indices_;
  float largest_step_;  ///< of ranges from pixel to pixel, a share
};

}  // namespace

std::vector<Eigen::Vector3f> scan_normals(std::span<const Eigen::Vector3f> points_m,
                                          const SensorOptions& sensor, int width, int height) {
  const PointImage image(points_m, sensor, width, height);
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(points_m.size());
  for (const Eigen::Vector3f& point_m : points_m) normals.push_back(image.normal(point_m));
  return normals;
}

Eigen::Vector3d entered_face_normal(const Eigen::Vector3d& origin, const Eigen::Vector3d& point,
                                    VoxelKey voxel) {
  const Eigen::Vector3d corner(voxel.x, voxel.y, voxel.z);
  const Eigen::Vector3d way = point - origin;
  double latest = 0.0;  // a share of the way
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (way[i] == 0.0) continue;
    const double face = way[i] > 0.0 ? corner[i] : corner[i] + 1.0;
    const double share = (face - origin[i]) / way[i];
    if (share <= latest) continue;
    latest = share;
    normal = Eigen::Vector3d::Unit(i) * (way[i] > 0.0 ? -1.0 : 1.0);
  }
  return normal;
}

}  // namespace nbvopt
