#include "solvers/strategy/recording_objective.hpp"

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

}  // namespace nbvopt
