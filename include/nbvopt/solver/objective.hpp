// What a solver sees of a problem: nothing of maps, so that every solver runs on textbook
// functions.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace nbvopt {

/// Points of the search space; one column vector each.
using Point = Eigen::VectorXd;

/// A closed box, lower <= upper in each coordinate. Equal bounds freeze a coordinate.
struct Box {
  Point lower;
  Point upper;

  Eigen::Index dimension() const { return lower.size(); }
  bool contains(const Point& x) const {
    return (x.array() >= lower.array()).all() && (x.array() <= upper.array()).all();
  }
  Point clamp(const Point& x) const { return x.cwiseMax(lower).cwiseMin(upper); }
};

/// A function to be maximised over a box. Thread-safe where batch solvers are used.
class Objective {
 public:
  virtual ~Objective() = default;

  virtual const Box& box() const = 0;

  virtual double value(const Point& x) const = 0;

  /// The values of many points; values.size() == points.size(). May use all cores.
  virtual void values(std::span<const Point> points, std::span<double> values) const {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = value(points[i]);
  }

  /// Decides between points of equal value: the lower cost wins. For a mast, the motion.
  virtual double tie_cost(const Point& /*x*/) const { return 0.0; }

  /// The period of a coordinate that turns: x and x + period are the same point, and the box is
  /// exactly one period wide. 0 for any other.
  virtual double period(Eigen::Index /*coordinate*/) const { return 0.0; }

  /// The length over which values change in their details: steps and tolerances of local searches
  /// count in it. A fiftieth of the box where nothing better is known.
  virtual double length_scale(Eigen::Index coordinate) const {
    return (box().upper[coordinate] - box().lower[coordinate]) / 50.0;
  }

  /// A cheaper objective over the same box with nearly the same values, smooth if need be, or null.
  virtual const Objective* surrogate() const { return nullptr; }

  virtual bool has_gradient() const { return false; }

  /// The value, and its gradient in `gradient`. Only where has_gradient().
  virtual double value_and_gradient(const Point& x, Point& gradient) const {
    gradient.setZero(x.size());
    return value(x);
  }

  /// True when the objective is also a least-squares problem: value(x) = constant - |r(x)|^2, so
  /// that it is largest where the sum of squared residuals is smallest.
  virtual bool has_residuals() const { return false; }

  /// The length of r. Only where has_residuals(); the same for every point.
  virtual Eigen::Index residual_count() const { return 0; }

  /// The value, r(x) in `residuals` and, unless null, dr/dx in `jacobian` (a row a residual, a
  /// column a coordinate). Only where has_residuals().
  virtual double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                                     Eigen::MatrixXd* jacobian) const {
    residuals.resize(0);
    if (jacobian) jacobian->resize(0, x.size());
    return value(x);
  }
};

}  // namespace nbvopt
