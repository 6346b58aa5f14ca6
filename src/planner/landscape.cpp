#include "planner/landscape.hpp"

#include <algorithm>
#include <cmath>

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

/// Where a value lies on an axis: after this entry, by this share of the way to the next.
struct AxisPlace {
  std::size_t before;
  std::size_t after;
  double share;
};

AxisPlace place(const std::vector<double>& axis, double value) {
  if (axis.size() == 1) return {0, 0, 0.0};
  const double steps = (value - axis.front()) / (axis.back() - axis.front()) * (axis.size() - 1.0);
  const double inside = std::clamp(steps, 0.0, axis.size() - 1.0);
  const std::size_t before = std::min(static_cast<std::size_t>(inside), axis.size() - 2);
  return {before, before + 1, inside - static_cast<double>(before)};
}

Json view_json(const JointPosition& joints, double gain) {
  return {{"pan", joints.pan_rad},
          {"tilt", joints.tilt_rad},
          {"height", joints.height_m},
          {"gain", gain}};
}

}  // namespace

double GainLandscape::interpolated(double pan_rad_at, double tilt_rad_at) const {
  const AxisPlace pan = place(pan_rad, pan_rad_at);
  const AxisPlace tilt = place(tilt_rad, tilt_rad_at);
  return std::lerp(std::lerp(at(pan.before, tilt.before), at(pan.after, tilt.before), pan.share),
                   std::lerp(at(pan.before, tilt.after), at(pan.after, tilt.after), pan.share),
                   tilt.share);
}

GainLandscape sample_landscape(const ViewEvaluator& evaluator, const Mast& mast,
                               const PlanRequest& request, const PlanResult& result) {
  constexpr std::size_t kMostViews = 20000;
  const JointBox& box = result.box;
  const Eigen::Vector3d width = box.max - box.min;
  double spacing_rad = 0.05;
  while (axis_count(width[0], spacing_rad) * axis_count(width[1], spacing_rad) > kMostViews) {
    spacing_rad *= 1.1;
  }
  GainLandscape landscape;
  landscape.height_m = result.joints.height_m;
  landscape.pan_rad = axis(box.min[0], box.max[0], axis_count(width[0], spacing_rad));
  landscape.tilt_rad = axis(box.min[1], box.max[1], axis_count(width[1], spacing_rad));

  std::vector<Transform> poses;
  for (const double tilt_rad : landscape.tilt_rad) {
    for (const double pan_rad : landscape.pan_rad) {
      poses.push_back(T_map_sensor(request, mast, {pan_rad, tilt_rad, landscape.height_m}));
    }
  }
  for (const ViewGain& view : evaluate_views(evaluator, poses)) landscape.gain.push_back(view.gain);
  return landscape;
}

std::vector<TracePoint> improvements(const std::vector<TracePoint>& trace) {
  std::vector<TracePoint> path;
  for (const TracePoint& point : trace) {
    if (point.kind != EvaluationKind::exact) continue;
    if (path.empty() || point.gain > path.back().gain) path.push_back(point);
  }
  return path;
}

Json to_json(const GainLandscape& landscape, const PlanRequest& request, const PlanResult& result,
             const std::vector<double>& candidate_pans_rad) {
  Json rows = Json::array();
  const auto columns = static_cast<std::ptrdiff_t>(landscape.pan_rad.size());
  for (auto row = landscape.gain.begin(); row != landscape.gain.end(); row += columns) {
    rows.push_back(std::vector<double>(row, row + columns));
  }
  Json candidates = Json::array();
  for (const double pan_rad : candidate_pans_rad) {
    candidates.push_back({{"pan", pan_rad}, {"tilt", request.joints.tilt_rad}});
  }
  Json path = Json::array();
  for (const TracePoint& point : improvements(result.trace)) {
    path.push_back(view_json(point.joints, point.gain));
  }
  return {{"height", landscape.height_m},
          {"pan", landscape.pan_rad},
          {"tilt", landscape.tilt_rad},
          {"gain", rows},
          {"start", view_json(request.joints, result.current.gain)},
          {"chosen", view_json(result.joints, result.view.gain)},
          {"candidates", candidates},
          {"path", path}};
}

}  // namespace nbvopt
