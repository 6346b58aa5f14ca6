#include "nbvopt/planner/landscape.hpp"

#include <algorithm>
#include <cmath>

#include "nbvopt/solver/grid_coordinates.hpp"

namespace nbvopt {
namespace {

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

}  // namespace

double Landscape::interpolated(double pan_rad_at, double tilt_rad_at) const {
  const AxisPlace pan = place(pan_rad, pan_rad_at);
  const AxisPlace tilt = place(tilt_rad, tilt_rad_at);
  return std::lerp(std::lerp(at(pan.before, tilt.before), at(pan.after, tilt.before), pan.share),
                   std::lerp(at(pan.before, tilt.after), at(pan.after, tilt.after), pan.share),
                   tilt.share);
}

std::vector<TracePoint> improvements(const std::vector<TracePoint>& trace) {
  std::vector<TracePoint> path;
  for (const TracePoint& point : trace) {
    if (point.kind != EvaluationKind::exact) continue;
    if (path.empty() || point.gain > path.back().gain) path.push_back(point);
  }
  return path;
}

std::vector<double> candidate_pans(const JointBox& box, double step_rad) {
  constexpr double kMostToDraw = 200.0;
  const double width_rad = box.max[0] - box.min[0];
  if (step_rad <= width_rad / kMostToDraw) return {};
  return grid_coordinates(box.min[0], box.max[0], step_rad);
}

}  // namespace nbvopt
