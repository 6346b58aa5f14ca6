// The released code's gain loop, as a baseline: it keeps its sampling, its one octree search a
// sample and its single core, and must not be made faster.
#include <cmath>

#include "gain/camera_pose_check.hpp"
#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {
namespace {

class PaperCodeEvaluator final : public ViewEvaluator {
 public:
  PaperCodeEvaluator(const UncertaintyMap& map, const SensorOptions& sensor)
      : map_(map),
        tree_(detail::MapAccess::tree(map)),
        sensor_(sensor),
        uncertainty_(sensor),
        none_stored_(map.carries_uncertainty() ? 1.0 : sensor.occupied_uncertainty) {
    sensor_.validate();
    // Points at depth 1 along the optical axis; a sample at r is r times as far.
    const CameraRays rays = make_rays(sensor, sensor.horizontal_rays, sensor.vertical_rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3d d = rays.direction(i);
      unit_points_.push_back(sensor.range_axis == RangeAxis::z_depth ? (d / d.z()).eval() : d);
    }
  }

  std::string name() const override { return "paper-code"; }

  ViewGain evaluate(const Transform& T_map_sensor) const override {
    detail::check_camera_pose(T_map_sensor, map_.lattice());
    ViewGain view;
    for (const Eigen::Vector3d& unit_point : unit_points_) {
      add_ray(T_map_sensor, unit_point, view);
    }
    view.gain = view.unknown_gain + view.occupied_gain;
    return view;
  }

 private:
  void add_ray(const Transform& T_map_sensor, const Eigen::Vector3d& unit_point,
               ViewGain& view) const {
    for (int i = 0;; ++i) {
      const double r = sensor_.range_min_m + i * map_.resolution_m();
      if (r >= sensor_.range_max_m) break;
      const Eigen::Vector3d p_sensor = r * unit_point;
      const Eigen::Vector3d p_map = T_map_sensor * p_sensor;
      const UncertaintyOcTreeNode* node = tree_.search(
          octomap::point3d(static_cast<float>(p_map.x()), static_cast<float>(p_map.y()),
                           static_cast<float>(p_map.z())));
      if (node == nullptr) {
        ++view.unknown_rays;
        view.unknown_gain += 1.0 - uncertainty_.uncertainty(p_sensor);  // Equation (12)
        return;
      }
      if (tree_.isNodeOccupied(node)) {
        const double u_old =
            node->uncertainty() == kUnknownUncertainty ? none_stored_ : node->uncertainty();
        ++view.occupied_rays;
        view.occupied_gain +=
            std::max(0.0, u_old - uncertainty_.uncertainty(p_sensor));  // Equation (12)
        return;
      }
    }
    ++view.free_rays;
  }

  const UncertaintyMap& map_;
  const UncertaintyOcTree& tree_;
  SensorOptions sensor_;
  UncertaintyModel uncertainty_;
  double none_stored_;
  std::vector<Eigen::Vector3d> unit_points_;
};

}  // namespace

std::unique_ptr<ViewEvaluator> make_paper_code_evaluator(const UncertaintyMap& map,
                                                         const SensorOptions& sensor) {
  return std::make_unique<PaperCodeEvaluator>(map, sensor);
}

SensorOptions paper_code_sensor(SensorOptions sensor) {
  sensor.ray_pattern = RayPattern::equal_angles;
  sensor.range_axis = RangeAxis::z_depth;
  sensor.uncertainty_half_fov_horizontal_rad = 0.52;
  sensor.uncertainty_half_fov_vertical_rad = 0.41;
  sensor.near_blocking = false;
  sensor.counting = Counting::per_ray;
  return sensor;
}

}  // namespace nbvopt
