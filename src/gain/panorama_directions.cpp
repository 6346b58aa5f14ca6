#include "gain/panorama_directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nbvopt::detail {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kPatchSide = 4;
static_assert(kPatchSide * kPatchSide == HitBlock::kSize);

Eigen::Vector3d unit(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

/// The number of rays along a length, whole patches.
int ray_count(double length_rad, double spacing_rad) {
  return kPatchSide *
         std::max(1, static_cast<int>(std::ceil(length_rad / (kPatchSide * spacing_rad) - 1e-9)));
}

}  // namespace

DirectionRange directions_in_reach(const JointBox& box, double half_fov_h_rad,
                                   double half_fov_v_rad) {
  const double tan_h = std::tan(half_fov_h_rad);
  const double tan_v = std::tan(half_fov_v_rad);
  double azimuth_reach = 0.0;
  DirectionRange range{box.min[0], box.max[0], kPi / 2, -kPi / 2};
  // The extremes lie at the ends of the tilts, at corners or in the middle of edges of the image.
  for (const double tilt_rad : {box.min[1], std::clamp(0.0, box.min[1], box.max[1]), box.max[1]}) {
    for (const double right : {-tan_h, 0.0, tan_h}) {
      for (const double down : {-tan_v, 0.0, tan_v}) {
        const double ahead = std::cos(tilt_rad) + down * std::sin(tilt_rad);
        const double up = std::sin(tilt_rad) - down * std::cos(tilt_rad);
        const double elevation = std::atan2(up, std::hypot(ahead, right));
        azimuth_reach = std::max(azimuth_reach, std::abs(std::atan2(right, ahead)));
        range.elevation_min = std::min(range.elevation_min, elevation);
        range.elevation_max = std::max(range.elevation_max, elevation);
      }
    }
    // An image that holds a pole sees every azimuth.
    for (const double pole : {-kPi / 2, kPi / 2}) {
      if (std::abs(pole - tilt_rad) > half_fov_v_rad) continue;
      azimuth_reach = kPi;
      range.elevation_min = std::min(range.elevation_min, pole);
      range.elevation_max = std::max(range.elevation_max, pole);
    }
  }
  range.azimuth_min -= azimuth_reach;
  range.azimuth_max = std::min(range.azimuth_max + azimuth_reach, range.azimuth_min + 2.0 * kPi);
  return range;
}

PanoramaDirections::PanoramaDirections(const DirectionRange& range, double spacing_h_rad,
                                       double spacing_v_rad, const JointBox& box,
                                       const Eigen::Vector3d& sensor_offset_m,
                                       const Eigen::Matrix3d& R_map_base) {
  const double height_rad = range.elevation_max - range.elevation_min;
  const double width_rad = range.azimuth_max - range.azimuth_min;
  const int rows = ray_count(height_rad, spacing_v_rad);
  const double row_rad = height_rad / rows;
  const auto elevation = [&](double row) { return range.elevation_min + row * row_rad; };
  const auto reserve = [](std::size_t n, auto&... vectors) { (vectors.reserve(n), ...); };
  const auto patches = static_cast<std::size_t>(rows / kPatchSide) *
                       static_cast<std::size_t>(ray_count(width_rad, spacing_h_rad) / kPatchSide);
  reserve(patches * HitBlock::kSize, x, y, z, solid_angle);
  reserve(patches, axis_x, axis_y, axis_z, radius, lever_x, lever_y, lever_z, apex_beside,
          apex_above);

  for (int low = 0; low < rows; low += kPatchSide) {
    const double flattest =
        std::max(std::cos(elevation(low)), std::cos(elevation(low + kPatchSide)));
    const int columns = ray_count(width_rad * flattest, spacing_h_rad);
    const double column_rad = width_rad / columns;
    const double middle_rad = elevation(low + 0.5 * kPatchSide);
    // The rows' sines and cosines, and how tall a ray's cell is.
    std::array<double, kPatchSide> sine{}, cosine{}, band{};
    for (int i = 0; i < kPatchSide; ++i) {
      const auto k = static_cast<std::size_t>(i);
      sine[k] = std::sin(elevation(low + i + 0.5));
      cosine[k] = std::cos(elevation(low + i + 0.5));
      band[k] = column_rad * (std::sin(elevation(low + i + 1)) - std::sin(elevation(low + i)));
    }
    const double tilt_rad = std::clamp(middle_rad, box.min[1], box.max[1]);
    const Eigen::Vector3d lever =
        Eigen::AngleAxisd(-tilt_rad, Eigen::Vector3d::UnitY()) * sensor_offset_m;
    // The origins go round the mast's axis, and up and down while the tilt follows.
    const double beside_m = lever.x() / std::cos(middle_rad);
    const double above_m = tilt_rad == middle_rad ? sensor_offset_m.x() : 0.0;
    // The farthest ray of a patch is a corner's.
    const double corner_rad = (0.5 * kPatchSide - 0.5) * column_rad;
    const double farthest =
        std::acos(std::min(std::cos(middle_rad) * cosine.front() * std::cos(corner_rad) +
                               std::sin(middle_rad) * sine.front(),
                           std::cos(middle_rad) * cosine.back() * std::cos(corner_rad) +
                               std::sin(middle_rad) * sine.back()));

    for (int left = 0; left < columns; left += kPatchSide) {
      std::array<double, kPatchSide> ahead{}, aside{};
      for (int i = 0; i < kPatchSide; ++i) {
        const double azimuth_rad = range.azimuth_min + (left + i + 0.5) * column_rad;
        ahead[static_cast<std::size_t>(i)] = std::cos(azimuth_rad);
        aside[static_cast<std::size_t>(i)] = std::sin(azimuth_rad);
      }
      for (std::size_t row = 0; row < kPatchSide; ++row) {
        for (std::size_t column = 0; column < kPatchSide; ++column) {
          x.push_back(cosine[row] * ahead[column]);
          y.push_back(cosine[row] * aside[column]);
          z.push_back(sine[row]);
          solid_angle.push_back(band[row]);
        }
      }
      const double azimuth_rad = range.azimuth_min + (left + 0.5 * kPatchSide) * column_rad;
      const Eigen::Vector3f axis = (R_map_base * unit(azimuth_rad, middle_rad)).cast<float>();
      const Eigen::Vector3f lever_map =
          (R_map_base * (Eigen::AngleAxisd(azimuth_rad, Eigen::Vector3d::UnitZ()) * lever))
              .cast<float>();
      axis_x.push_back(axis.x());
      axis_y.push_back(axis.y());
      axis_z.push_back(axis.z());
      radius.push_back(static_cast<float>(farthest));
      lever_x.push_back(lever_map.x());
      lever_y.push_back(lever_map.y());
      lever_z.push_back(lever_map.z());
      apex_beside.push_back(static_cast<float>(beside_m));
      apex_above.push_back(static_cast<float>(above_m));
    }
  }
}

}  // namespace nbvopt::detail
