#include "nbvopt/gain/hazard_table.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "gain/camera_pose_check.hpp"
#include "gain/passage_walk.hpp"

namespace nbvopt {
namespace {

/// A sample of a scan's rays, in the sensor frame, and how far each was seen to be free.
struct SampledRays {
  std::vector<double> x, y, z, range_min_m, range_max_m;
  std::vector<bool> has_return;

  void add(const Eigen::Vector3d& direction, double range_m, bool returns,
           const SensorOptions& sensor) {
    const double length = direction.norm();
    // The range may run along the optical axis.
    const double per_range = sensor.range_axis == RangeAxis::z_depth ? length / direction.z() : 1.0;
    const bool is_in_range = returns && range_m < sensor.range_max_m;
    x.push_back(direction.x() / length);
    y.push_back(direction.y() / length);
    z.push_back(direction.z() / length);
    range_min_m.push_back(sensor.range_min_m * per_range);
    range_max_m.push_back((is_in_range ? range_m : sensor.range_max_m) * per_range);
    has_return.push_back(is_in_range);
  }
};

SampledRays sample(const Scan& scan, const SensorOptions& sensor) {
  constexpr std::size_t kRays = 500;
  const std::size_t all = scan.points_m.size() + scan.no_returns.size();
  // Odd, so that the sample does not stay on a few columns of an image.
  const std::size_t stride = std::max<std::size_t>(1, all / kRays) | 1U;
  SampledRays rays;
  for (std::size_t i = stride / 2; i < all; i += stride) {
    const bool returns = i < scan.points_m.size();
    const Eigen::Vector3d p =
        (returns ? scan.points_m[i] : scan.no_returns[i - scan.points_m.size()]).cast<double>();
    const double range_m = sensor.range_axis == RangeAxis::z_depth ? p.z() : p.norm();
    if (!p.allFinite() || !(range_m > 0.0)) continue;
    if (returns && range_m <= sensor.range_min_m) continue;
    if (!returns && sensor.no_return == NoReturn::ignore) continue;
    rays.add(p, range_m, returns, sensor);
  }
  return rays;
}

}  // namespace

HazardTable::HazardTable(double floor_map_m) : floor_map_m_(floor_map_m) {
  // Hits a metre in the drives of docs/results.md, pooled, in the order of the contexts.
  constexpr std::array<double, kContexts> kHazards_per_m{1.46,  11.4, 2.13,  5.0,  //
                                                         0.129, 6.2,  0.131, 5.6,  //
                                                         0.138, 7.3,  0.076, 3.6,  //
                                                         0.033, 1.02};
  // So few that a minute of another place's scans outweighs them.
  constexpr double kMetres = 2.0;
  for (std::size_t c = 0; c < kContexts; ++c) {
    counts_[c] = {.hits = kHazards_per_m[c] * kMetres, .metres = kMetres};
  }
}

HazardTable HazardTable::uniform(double hits_per_m) {
  HazardTable table;
  for (std::size_t context = 0; context < kContexts; ++context) {
    const bool is_unknown = context < kUnknownContexts;
    table.counts_[context] = {.hits = is_unknown ? hits_per_m : 0.0, .metres = 1.0};
  }
  return table;
}

void learn_hazards(const VoxelGrid& grid, const Scan& scan, const Transform& T_map_sensor,
                   const SensorOptions& sensor, HazardTable& hazards) {
  detail::check_camera_pose(T_map_sensor, grid.lattice());
  const SampledRays rays = sample(scan, sensor);
  const RayBundle bundle{T_map_sensor,     rays.x,           rays.y, rays.z,
                         rays.range_min_m, rays.range_max_m, false};
  RayHits directions;
  directions.resize(bundle.size());
  const detail::RayBounds bounds = detail::scalar_kernel().rotate_and_bound(bundle, directions);
  const detail::RayWalk walk = detail::make_walk(grid, bundle, 1.0, bounds);
  for (std::size_t i = 0; i < bundle.size(); ++i) {
    detail::ScalarRay ray(
        walk, {directions.direction_x[i], directions.direction_y[i], directions.direction_z[i]});
    const double far_m = rays.range_max_m[i];
    detail::PassagePiece last{};
    const auto visit = [&](const detail::PassagePiece& piece) {
      hazards.add(piece.context, {.hits = 0.0, .metres = piece.end_m - piece.begin_m});
      last = piece;
      return true;
    };
    // The map is wrong about an occupied voxel that the ray has passed: what it says of those
    // behind cannot be trusted either.
    const auto ends_at = [](double /*leaves_m*/) { return true; };
    const detail::PassageEnd end =
        detail::walk_passage(walk, hazards, ray, directions.direction_z[i], far_m, visit, ends_at);
    if (end == detail::PassageEnd::far && rays.has_return[i] && last.end_m == far_m) {
      hazards.add(last.context, {.hits = 1.0, .metres = 0.0});
    }
  }
}

}  // namespace nbvopt
