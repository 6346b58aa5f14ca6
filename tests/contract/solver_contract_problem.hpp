// Textbook functions with a notebook, for the solvers' contract.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt::testing_contract {

/// r(x) and dr/dx of a least-squares problem.
using ResidualFunction =
    std::function<void(const Point& x, Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian)>;

/// One evaluation that a solver asked for.
struct Record {
  Point x;
  double value;
};

/// What makes a problem and its surrogate.
struct Textbook {
  Box box;
  Eigen::Index residual_count;
  ResidualFunction residuals;
  Eigen::Index periodic_coordinate = -1;  ///< turns once over the box; -1: none
  bool has_surrogate = true;              ///< a small smooth error away
};

/// value(x) = top - |r(x)|^2, so that gradient and residuals follow from r. Writes down every
/// evaluation, calls a hook before each, and evaluates batches on several threads.
class TextbookProblem final : public Objective {
 public:
  explicit TextbookProblem(Textbook textbook);

  static constexpr double kTop = 10.0;

  /// Called before each evaluation with its number, from 1 on; may throw.
  std::function<void(std::size_t)> before_evaluation = [](std::size_t) {};
  /// Threads of values(), of the surrogate too.
  void use_threads(std::size_t threads);

  const std::vector<Record>& records() const { return records_; }

  const Box& box() const override { return textbook_.box; }
  double period(Eigen::Index coordinate) const override;
  const TextbookProblem* surrogate() const override { return surrogate_.get(); }
  TextbookProblem* surrogate() { return surrogate_.get(); }
  double value(const Point& x) const override;
  void values(std::span<const Point> points, std::span<double> values) const override;
  double tie_cost(const Point& x) const override { return x.norm(); }
  bool has_gradient() const override { return true; }
  double value_and_gradient(const Point& x, Point& gradient) const override;
  bool has_residuals() const override { return true; }
  Eigen::Index residual_count() const override { return textbook_.residual_count; }
  double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                             Eigen::MatrixXd* jacobian) const override;

 private:
  Textbook textbook_;
  std::unique_ptr<TextbookProblem> surrogate_;
  std::size_t threads_ = 1;
  mutable std::mutex mutex_;
  mutable std::vector<Record> records_;
  mutable std::size_t evaluations_ = 0;
};

/// A concave quadratic in three coordinates over [-1, 2]^3 with its top at `optimum`, which may lie
/// outside the box.
TextbookProblem quadratic(const Eigen::Vector3d& optimum);

/// Many local optima in two coordinates over [-4, 5]^2, about 1 apart in place and value; the
/// global one is kTop at (1.3, -0.7).
TextbookProblem rastrigin();

/// kTop everywhere in a square around (0.5, 0.5), falling off outside; over [-2, 2]^2.
TextbookProblem plateau();

/// The quadratic with its top at (0.2, 0.3, 0.4), and NaN wherever `is_nan` says so.
TextbookProblem quadratic_with_nan(std::function<bool(const Point&)> is_nan);

/// The quadratic with its top at (0.2, 0.3, 0.4) over another box.
TextbookProblem quadratic_over(Box box);

}  // namespace nbvopt::testing_contract
