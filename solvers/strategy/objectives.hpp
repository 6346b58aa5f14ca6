// Objectives that stand before another: one remembers what was asked of it, one moves the seam of
// coordinates that turn.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// Forwards everything to another objective, and keeps every point with its value. A value known
/// already is not evaluated again, nor counted. Used by one thread.
class RecordingObjective final : public Objective {
 public:
  explicit RecordingObjective(const Objective& objective);

  /// The points, a column each, in the order of their evaluation.
  Eigen::Map<const Eigen::MatrixXd> points() const;
  std::span<const double> values() const { return values_; }
  std::int64_t evaluations() const { return static_cast<std::int64_t>(values_.size()); }

  const Box& box() const override { return objective_.box(); }
  double value(const Point& x) const override;
  void values(std::span<const Point> points, std::span<double> values) const override;
  double tie_cost(const Point& x) const override { return objective_.tie_cost(x); }
  double period(Eigen::Index coordinate) const override { return objective_.period(coordinate); }
  double length_scale(Eigen::Index coordinate) const override {
    return objective_.length_scale(coordinate);
  }
  bool has_gradient() const override { return objective_.has_gradient(); }
  double value_and_gradient(const Point& x, Point& gradient) const override;
  bool has_residuals() const override { return objective_.has_residuals(); }
  Eigen::Index residual_count() const override { return objective_.residual_count(); }
  double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                             Eigen::MatrixXd* jacobian) const override;

 private:
  double record(const Point& x, double value) const;

  const Objective& objective_;
  mutable std::vector<double> coordinates_;  ///< point by point, so that none allocates
  mutable std::vector<double> values_;
};

/// The same objective over a box that has `centre` in the middle of every periodic coordinate.
/// A local search crosses the seam with it; what is evaluated lies in the objective's own box, to
/// the last bit.
class ShiftedPeriod final : public Objective {
 public:
  ShiftedPeriod(const Objective& objective, const Point& centre);

  /// The same point in the objective's own box.
  Point wrapped(const Point& x) const;

  const Box& box() const override { return box_; }
  double value(const Point& x) const override { return objective_.value(wrapped(x)); }
  void values(std::span<const Point> points, std::span<double> values) const override;
  double tie_cost(const Point& x) const override { return objective_.tie_cost(wrapped(x)); }
  double period(Eigen::Index coordinate) const override { return objective_.period(coordinate); }
  double length_scale(Eigen::Index coordinate) const override {
    return objective_.length_scale(coordinate);
  }
  bool has_gradient() const override { return objective_.has_gradient(); }
  double value_and_gradient(const Point& x, Point& gradient) const override {
    return objective_.value_and_gradient(wrapped(x), gradient);
  }
  bool has_residuals() const override { return objective_.has_residuals(); }
  Eigen::Index residual_count() const override { return objective_.residual_count(); }
  double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                             Eigen::MatrixXd* jacobian) const override {
    return objective_.value_and_residuals(wrapped(x), residuals, jacobian);
  }

 private:
  const Objective& objective_;
  Box box_;
};

}  // namespace nbvopt
