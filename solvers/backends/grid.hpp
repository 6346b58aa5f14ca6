// The paper's discretised search, Algorithms 1 and 2.
#pragma once

#include <vector>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// Evaluates the start and every point of a lattice over the box, and takes the best. The lattice
/// begins at the box's lower end; a coordinate whose step is 0 stays at the start's value.
class GridSolver final : public Solver {
 public:
  static constexpr double kMaxCandidates = 1e7;

  /// One step a coordinate. Throws UsageError when one is negative or not finite.
  explicit GridSolver(std::vector<double> steps);

  std::string name() const override { return "grid"; }

 private:
  /// Throws UsageError when there is not one step a coordinate, or more than kMaxCandidates.
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  std::vector<double> steps_;
};

}  // namespace nbvopt
