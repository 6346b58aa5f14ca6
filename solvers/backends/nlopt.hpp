// The algorithms of the NLopt library.
#pragma once

#include <string>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// One NLopt algorithm, run over the unit box of the coordinates that can move.
///
/// Global: direct-l, crs2, isres, esch, mlsl-lds, ags; with gradient, stogo.
/// Local: bobyqa, sbplx, cobyla; with gradient, lbfgs, slsqp, mma.
/// mlsl-lds starts L-BFGS where the objective has a gradient, else BOBYQA.
class NloptSolver final : public Solver {
 public:
  /// `name` is one of the above after "nlopt:"; `tolerance` and `initial_step` as in SolverOptions.
  /// Throws UsageError when the tolerance is not above 0 and finite, or the step not
  /// 0 or more and finite.
  NloptSolver(const std::string& name, double tolerance, double initial_step);

  std::string name() const override { return name_; }
  SolverNeeds needs() const override;

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  std::string name_;
  double tolerance_;
  double initial_step_;
};

}  // namespace nbvopt
