// The two local searches of the Ceres library.
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solvers/answer.hpp"
#include "solvers/families.hpp"
#include "solvers/tracked_objective.hpp"
#include "solvers/unit_box.hpp"

namespace nbvopt {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Changes of the cost below this share of it are rounding.
constexpr double kFunctionTolerance = 1e-12;

/// On a face the sine is flat, and so is every function over it: a start there is moved inwards by
/// this share of the width. The start itself has been evaluated by then.
constexpr double kFaceMargin = 0.01;

/// An iteration takes an evaluation at least, so the stop rule's own limit holds first.
int max_iterations(const StopRule& stop) {
  return static_cast<int>(
      std::min<std::int64_t>(stop.max_evaluations, std::numeric_limits<int>::max()));
}

SolveStatus status_of(ceres::TerminationType termination) {
  return termination == ceres::CONVERGENCE ? SolveStatus::converged : SolveStatus::stalled;
}

/// The negative value as a function of t, u = (1 + sin t) / 2.
class SineCost final : public ceres::FirstOrderFunction {
 public:
  SineCost(TrackedObjective& tracked, const UnitBox& unit_box)
      : tracked_(tracked), unit_box_(unit_box) {}

  static Point t_from_unit(const Point& u) {
    return (2.0 * u.array().max(kFaceMargin).min(1.0 - kFaceMargin) - 1.0).asin();
  }

  bool Evaluate(const double* t_data, double* cost, double* gradient) const override {
    const Eigen::Map<const Eigen::ArrayXd> t(t_data, NumParameters());
    if (!t.allFinite()) return false;
    const Point u = 0.5 * (1.0 + t.sin());
    const Evaluation* evaluation = tracked_.evaluate(unit_box_.from_unit(u));
    if (!evaluation || !std::isfinite(evaluation->value) || !evaluation->gradient.allFinite()) {
      return false;
    }
    *cost = -evaluation->value;
    if (gradient) {
      const Point unit_gradient = unit_box_.unit_gradient(evaluation->gradient);
      Eigen::Map<Eigen::ArrayXd>(gradient, NumParameters()) =
          -unit_gradient.array() * 0.5 * t.cos();
    }
    return true;
  }

  int NumParameters() const override { return static_cast<int>(unit_box_.dimension()); }

 private:
  TrackedObjective& tracked_;
  const UnitBox& unit_box_;
};

/// The residuals as a function of u.
class ResidualCost final : public ceres::CostFunction {
 public:
  ResidualCost(TrackedObjective& tracked, const UnitBox& unit_box, Eigen::Index residual_count)
      : tracked_(tracked), unit_box_(unit_box) {
    set_num_residuals(static_cast<int>(residual_count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(unit_box.dimension()));
  }

  static bool is_usable(const Evaluation& evaluation) {
    return std::isfinite(evaluation.value) && evaluation.residuals.allFinite() &&
           evaluation.jacobian.allFinite();
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Point> u(parameters[0], unit_box_.dimension());
    if (!u.allFinite()) return false;
    const Evaluation* evaluation = tracked_.evaluate(unit_box_.from_unit(u));
    if (!evaluation || !is_usable(*evaluation)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = evaluation->residuals;
    if (jacobians && jacobians[0]) {
      Eigen::Map<RowMajorMatrix>(jacobians[0], num_residuals(), unit_box_.dimension()) =
          unit_box_.unit_jacobian(evaluation->jacobian);
    }
    return true;
  }

 private:
  TrackedObjective& tracked_;
  const UnitBox& unit_box_;
};

/// Ceres' L-BFGS. Its general problems have no bounds, so each coordinate runs over a sine,
/// u = (1 + sin t) / 2, whose ends are the box's faces.
class CeresLbfgsSolver final : public Solver {
 public:
  /// `tolerance` as in Search. Throws UsageError when it is not above 0 and finite.
  explicit CeresLbfgsSolver(double tolerance);

  std::string name() const override { return "ceres:lbfgs"; }
  SolverNeeds needs() const override { return {.gradient = true}; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  double tolerance_;
};

/// Ceres' Levenberg-Marquardt over the objective's residuals, with the box as bounds.
class CeresLmSolver final : public Solver {
 public:
  /// `tolerance` as in Search. Throws UsageError when it is not above 0 and finite.
  explicit CeresLmSolver(double tolerance);

  std::string name() const override { return "ceres:lm"; }
  SolverNeeds needs() const override { return {.residuals = true}; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  double tolerance_;
};

}  // namespace

CeresLbfgsSolver::CeresLbfgsSolver(double tolerance) : tolerance_(checked_tolerance(tolerance)) {}

SolveResult CeresLbfgsSolver::do_solve(const Objective& objective,
                                       const SolveRequest& request) const {
  const UnitBox unit_box(objective.box(), request.start);
  const SolveRequest bounded_request = bounded(request, unit_box.dimension());
  TrackedObjective tracked(objective, bounded_request, needs());
  if (unit_box.dimension() == 0) return tracked.result(SolveStatus::converged);

  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::LBFGS;
  options.max_num_iterations = max_iterations(bounded_request.stop);
  options.parameter_tolerance = tolerance_ * unit_box.unit_scale(objective).minCoeff();
  options.function_tolerance = kFunctionTolerance;
  options.logging_type = ceres::SILENT;

  const ceres::GradientProblem problem(new SineCost(tracked, unit_box));  // the problem owns it
  Point t = SineCost::t_from_unit(unit_box.unit_start());
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, t.data(), &summary);
  return tracked.result(status_of(summary.termination_type), "Ceres: " + summary.message);
}

CeresLmSolver::CeresLmSolver(double tolerance) : tolerance_(checked_tolerance(tolerance)) {}

SolveResult CeresLmSolver::do_solve(const Objective& objective, const SolveRequest& request) const {
  const UnitBox unit_box(objective.box(), request.start);
  const SolveRequest bounded_request = bounded(request, unit_box.dimension());
  TrackedObjective tracked(objective, bounded_request, needs());
  if (unit_box.dimension() == 0) return tracked.result(SolveStatus::converged);

  // Ceres would say so on standard error.
  if (!ResidualCost::is_usable(*tracked.evaluate(request.start))) {
    return tracked.result(SolveStatus::stalled, "the residuals at the start are not finite");
  }

  Point u = unit_box.unit_start();
  ceres::Problem problem;  // owns the cost
  problem.AddResidualBlock(new ResidualCost(tracked, unit_box, objective.residual_count()), nullptr,
                           u.data());
  for (int i = 0; i < static_cast<int>(unit_box.dimension()); ++i) {
    problem.SetParameterLowerBound(u.data(), i, 0.0);
    problem.SetParameterUpperBound(u.data(), i, 1.0);
  }

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = max_iterations(bounded_request.stop);
  options.parameter_tolerance = tolerance_ * unit_box.unit_scale(objective).minCoeff();
  options.function_tolerance = kFunctionTolerance;
  options.logging_type = ceres::SILENT;

  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return tracked.result(status_of(summary.termination_type), "Ceres: " + summary.message);
}

SolverFamily ceres_family() {
  return {.label = "ceres:*",
          .names = {"ceres:lbfgs", "ceres:lm"},
          .heeds = SearchParameters::tolerances,
          .make = [](const std::string& name, const Search& search) -> std::unique_ptr<Solver> {
            if (name == "ceres:lm") return std::make_unique<CeresLmSolver>(search.tolerance);
            return std::make_unique<CeresLbfgsSolver>(search.tolerance);
          }};
}

}  // namespace nbvopt
