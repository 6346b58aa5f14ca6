#include "planner/sample_landscape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nbvopt {
namespace {

std::size_t axis_count(double width_rad, double spacing_rad) {
  if (width_rad <= 0.0) return 1;
  return std::max<std::size_t>(2, 1 + static_cast<std::size_t>(std::ceil(width_rad / spacing_rad)));
}

std::vector<double> axis(double min_rad, double max_rad, std::size_t count) {
  std::vector<double> values{min_rad};
  for (std::size_t i = 1; i < count; ++i) {
    values.push_back(std::lerp(min_rad, max_rad, static_cast<double>(i) / (count - 1.0)));
  }
  return values;
}

}  // namespace

Landscape sample_landscape(const ViewEvaluator& evaluator, const Mast& mast,
                           const PlanResult& result, int threads, const StopRule& stop) {
  constexpr std::size_t kMostViews = 20000;
  const JointBox& box = result.box;
  const Eigen::Vector3d width = box.max - box.min;
  double spacing_rad = 0.05;
  while (axis_count(width[0], spacing_rad) * axis_count(width[1], spacing_rad) > kMostViews) {
    spacing_rad *= 1.1;
  }
  Landscape landscape;
  landscape.height_m = result.joints.height_m;
  landscape.pan_rad = axis(box.min[0], box.max[0], axis_count(width[0], spacing_rad));
  landscape.tilt_rad = axis(box.min[1], box.max[1], axis_count(width[1], spacing_rad));

  const MovingMast moving = moving_mast(result.request, mast);
  std::vector<Transform> poses;
  for (const double tilt_rad : landscape.tilt_rad) {
    for (const double pan_rad : landscape.pan_rad) {
      poses.push_back(moving.T_map_sensor({pan_rad, tilt_rad, landscape.height_m}));
    }
  }
  for (const ViewGain& view : evaluate_views(evaluator, poses, threads, stop)) {
    landscape.gain.push_back(view.gain);
  }
  return landscape;
}

}  // namespace nbvopt
