#include "solvers/strategy/shifted_period.hpp"

#include <vector>

namespace nbvopt {

ShiftedPeriod::ShiftedPeriod(const Objective& objective, const Point& centre)
    : objective_(objective), box_(objective.box()) {
  for (Eigen::Index i = 0; i < box_.dimension(); ++i) {
    const double period = objective.period(i);
    if (period == 0.0) continue;
    box_.lower[i] = centre[i] - 0.5 * period;
    box_.upper[i] = centre[i] + 0.5 * period;
  }
}

Point ShiftedPeriod::wrapped(const Point& x) const {
  const Box& own = objective_.box();
  Point result = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (x[i] < own.lower[i]) result[i] += objective_.period(i);
    if (x[i] > own.upper[i]) result[i] -= objective_.period(i);
  }
  return own.clamp(result);  // the period and the box's width may differ by rounding
}

void ShiftedPeriod::values(std::span<const Point> points, std::span<double> values) const {
  std::vector<Point> own_points;
  own_points.reserve(points.size());
  for (const Point& x : points) own_points.push_back(wrapped(x));
  objective_.values(own_points, values);
}

}  // namespace nbvopt
