// The two local searches of the Ceres library.
#pragma once

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// Ceres' L-BFGS. Its general problems have no bounds, so each coordinate runs over a sine,
/// u = (1 + sin t) / 2, whose ends are the box's faces.
class CeresLbfgsSolver final : public Solver {
 public:
  /// `tolerance` as in SolverOptions. Throws UsageError when it is not above 0 and finite.
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
  /// `tolerance` as in SolverOptions. Throws UsageError when it is not above 0 and finite.
  explicit CeresLmSolver(double tolerance);

  std::string name() const override { return "ceres:lm"; }
  SolverNeeds needs() const override { return {.residuals = true}; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  double tolerance_;
};

}  // namespace nbvopt
