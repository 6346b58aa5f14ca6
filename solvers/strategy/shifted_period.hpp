// Lets a local search cross the seam of a coordinate that turns.
#pragma once

#include <span>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// The same objective over a box that has `centre` in the middle of every periodic coordinate.
/// What is evaluated lies in the objective's own box, to the last bit.
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
