// The solvers by name: one explicit table, in solvers/registry.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// What a solver can be told when it is made.
struct SolverOptions {
  /// Of `grid`: the step of each coordinate; 0 freezes it at the start.
  std::vector<double> grid_steps;
  /// Of `nlopt:*` and `ceres:*`: the search has converged when a step changes every coordinate by
  /// less than this many of the objective's length scales.
  double tolerance = 5e-3;
  /// Of `nlopt:sbplx`, `nlopt:bobyqa` and `nlopt:cobyla`, which alone heed it: the first step, in
  /// length scales; 0 leaves it to the solver.
  double initial_step = 0.0;
};

std::vector<std::string> solver_names();

/// Throws UsageError: an unknown name (the known ones are listed), or a bad option.
std::unique_ptr<Solver> make_solver(const std::string& name, const SolverOptions& options);

}  // namespace nbvopt
