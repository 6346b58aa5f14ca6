// The coordinates of a box that can move, scaled to [0, 1], and the tolerance that searches over
// them have.
#pragma once

#include <vector>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// Maps [0, 1]^dimension() to a box, frozen coordinates (equal bounds) left out. Every mapped point
/// lies in the box to the last bit, 0 and 1 are its faces, and unit_start() maps to the start.
class UnitBox {
 public:
  UnitBox(const Box& box, const Point& start);

  /// How many coordinates can move.
  Eigen::Index dimension() const { return static_cast<Eigen::Index>(free_.size()); }

  const Point& unit_start() const { return unit_start_; }

  /// Objective::length_scale() in units, at most the whole box.
  Point unit_scale(const Objective& objective) const;

  /// Values outside [0, 1] are clamped.
  Point from_unit(const Point& u) const;

  /// d value / d u, of a gradient d value / d x.
  Point unit_gradient(const Point& gradient) const;

  /// d r / d u, of a Jacobian d r / d x.
  Eigen::MatrixXd unit_jacobian(const Eigen::MatrixXd& jacobian) const;

 private:
  const Box& box_;
  Point start_;
  std::vector<Eigen::Index> free_;
  Point width_;  ///< of the free coordinates
  Point unit_start_;
};

/// The tolerance as it is. Throws UsageError unless it is above 0 and finite.
double checked_tolerance(double tolerance);

}  // namespace nbvopt
