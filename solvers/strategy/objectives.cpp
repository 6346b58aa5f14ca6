#include "solvers/strategy/objectives.hpp"

namespace nbvopt {
namespace {

/// Room for the evaluations of an ordinary search.
constexpr std::size_t kReserved = 512;

}  // namespace

RecordingObjective::RecordingObjective(const Objective& objective) : objective_(objective) {
  coordinates_.reserve(kReserved * static_cast<std::size_t>(box().dimension()));
  values_.reserve(kReserved);
}

Eigen::Map<const Eigen::MatrixXd> RecordingObjective::points() const {
  return {coordinates_.data(), box().dimension(), static_cast<Eigen::Index>(values_.size())};
}

double RecordingObjective::value(const Point& x) const {
  const auto known = points();
  for (Eigen::Index i = 0; i < known.cols(); ++i) {
    if (known.col(i) == x) return values_[static_cast<std::size_t>(i)];
  }
  return record(x, objective_.value(x));
}

void RecordingObjective::values(std::span<const Point> points, std::span<double> values) const {
  objective_.values(points, values);
  for (std::size_t i = 0; i < points.size(); ++i) record(points[i], values[i]);
}

double RecordingObjective::value_and_gradient(const Point& x, Point& gradient) const {
  return record(x, objective_.value_and_gradient(x, gradient));
}

double RecordingObjective::value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                                               Eigen::MatrixXd* jacobian) const {
  return record(x, objective_.value_and_residuals(x, residuals, jacobian));
}

double RecordingObjective::record(const Point& x, double value) const {
  coordinates_.insert(coordinates_.end(), x.begin(), x.end());
  values_.push_back(value);
  return value;
}

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
