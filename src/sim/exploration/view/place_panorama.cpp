#include "sim/exploration/view/place_panorama.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "gain/panorama_layer.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {
namespace {

/// Of the panorama's rays, in spacings of the sensor's.
constexpr double kRaySpacing = 5.0;

/// Edge of the cubes, so that several rays of a panorama meet one.
constexpr double kCube_m = 0.5;

/// |alpha| / F (Eq. 5 and 6) of what is seen several times, which has half the mean over an image.
constexpr double kAngleUncertainty = 0.25;

/// All joint positions, the mast half way up: the base turns, so that every pan is in reach.
JointBox all_around(const MastOptions& mast) {
  const double height_m = 0.5 * (mast.height_min_m + mast.height_max_m);
  return {{-std::numbers::pi, mast.tilt_min_rad, height_m},
          {std::numbers::pi, mast.tilt_max_rad, height_m}};
}

std::uint64_t cube_at(const Eigen::Vector3d& position_map_m) {
  constexpr std::int64_t kMiddle = std::int64_t{1} << 20;
  const Eigen::Matrix<std::int64_t, 3, 1> cube =
      (position_map_m / kCube_m).array().floor().cast<std::int64_t>() + kMiddle;
  return static_cast<std::uint64_t>(cube.x()) | static_cast<std::uint64_t>(cube.y()) << 21 |
         static_cast<std::uint64_t>(cube.z()) << 42;
}

/// Adds up what lies in one cube.
void merge(PlaceGain& gains) {
  std::ranges::stable_sort(gains, {}, &CubeGain::cube);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (merged > 0 && gains[merged - 1].cube == gains[i].cube) {
      gains[merged - 1].information += gains[i].information;
    } else {
      gains[merged++] = gains[i];
    }
  }
  gains.resize(merged);
}

}  // namespace

PlacePanorama::PlacePanorama(const Robot& robot, double resolution_m)
    : robot_(robot),
      model_(robot.sensor, resolution_m),
      resolution_m_(resolution_m),
      box_(all_around(robot.mast)),
      directions_(detail::directions_in_reach(box_, model_.half_fov_h_rad, model_.half_fov_v_rad),
                  kRaySpacing * model_.ray_spacing_h_rad, kRaySpacing * model_.ray_spacing_v_rad,
                  box_, robot.mast.sensor_offset_m, Eigen::Matrix3d::Identity()) {}

PlaceGain PlacePanorama::look_around(const VoxelGrid& grid, const HazardTable& hazards,
                                     const Eigen::Vector3d& base_map_m) const {
  const SensorOptions& sensor = robot_.sensor;
  const detail::PassageModel passage{hazards, sensor.focal_distance_m, false};
  const detail::LayerCaster caster{
      .grid = grid,
      .directions = directions_,
      .R_map_base = Eigen::Matrix3d::Identity(),
      .range_min_m = sensor.range_min_m,
      .range_max_m = sensor.longest_range_m(),
      .near_blocking = sensor.near_blocking,
      .occupied_uncertainty = sensor.occupied_uncertainty,
      .weight_distance = model_.weight_distance,
      .normal_weight = sensor.normal_weight,
      .focal_distance_m = model_.focal_distance_m,
      .farthest_view_m = 0.0,
      .per_voxel = false,
      .has_lever = robot_.mast.sensor_offset_m.squaredNorm() > 0.0,
      .passage = sensor.gain == GainKind::positive ? nullptr : &passage};
  const Eigen::Vector3d centre_map_m = base_map_m + box_.min[2] * Eigen::Vector3d::UnitZ();
  detail::PanoramaLayer layer(caster, centre_map_m);
  std::vector<std::uint32_t> ids(directions_.patch_count());
  std::iota(ids.begin(), ids.end(), 0U);
  layer.cast(ids);
  std::vector<std::uint32_t> blocks;
  layer.blocks_of(ids, blocks);

  const UncertaintyModel uncertainty(sensor);
  const double angle_part = uncertainty.angle_weight() * kAngleUncertainty;
  PlaceGain gains;
  for (const std::uint32_t b : blocks) {
    const detail::HitBlock& block = layer.blocks()[b];
    for (std::size_t i = 0; i < detail::HitBlock::kSize; ++i) {
      const double area_m2 =
          Eigen::Vector3f(block.area_x[i], block.area_y[i], block.area_z[i]).norm();
      if (area_m2 == 0.0) continue;
      const Eigen::Vector3d hit_m =
          Eigen::Vector3f(block.x[i], block.y[i], block.z[i]).cast<double>();
      const double u_new = angle_part + uncertainty.distance_weight() *
                                            uncertainty.distance_uncertainty(hit_m.norm());
      if (block.u_old[i] <= u_new) continue;
      gains.push_back({cube_at(centre_map_m + hit_m),
                       area_m2 / (resolution_m_ * resolution_m_) * (block.u_old[i] - u_new)});
    }
  }
  merge(gains);
  return gains;
}

int views_around(const SensorOptions& sensor) {
  return static_cast<int>(std::ceil(std::numbers::pi / sensor.half_fov_horizontal_rad));
}

}  // namespace nbvopt
