// Uniform random sampling: the search that every other must beat.
#pragma once

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// Evaluates the start, then points drawn uniformly from the box. A seed draws the same points
/// with every standard library.
class RandomSolver final : public Solver {
 public:
  std::string name() const override { return "random"; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;
};

}  // namespace nbvopt
