// A search: one solver, or the stages of a strategy, with its parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/solver/solver.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt {

/// What to search with. Parameters count only for the solvers that heed them.
struct Search {
  std::optional<std::string> solver = {};  ///< of the registry; none: the stages, or else "auto"
  std::optional<StrategyOptions> stages = {};  ///< compose a search, instead of `solver`
  /// Of `grid`: the step of each coordinate; 0 freezes it at the start.
  std::vector<double> grid_steps = {};
  /// Of `nlopt:*` and `ceres:*`: the search has converged when a step changes every coordinate by
  /// less than this many of the objective's length scales.
  double tolerance = 5e-3;
  /// Of `nlopt:sbplx`, `nlopt:bobyqa` and `nlopt:cobyla`, which alone heed it: the first step, in
  /// length scales; 0 leaves it to the solver.
  double initial_step = 0.0;

  bool operator==(const Search&) const = default;
};

/// The solver of a search. Throws UsageError: an unknown name (the known ones are listed), a bad
/// parameter, solver and stages both given; and as make_strategy() does.
std::unique_ptr<Solver> make_solver(const Search& search);

/// The same for the solver of that name and the search's parameters.
std::unique_ptr<Solver> make_solver(const std::string& name, Search parameters);

}  // namespace nbvopt
