// A search: one solver, or the stages of a strategy, with its parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/solver/registry.hpp"
#include "nbvopt/solver/solver.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt {

/// What to search with. Parameters count only for the solvers that heed them.
struct Search {
  std::optional<std::string> solver = {};  ///< of the registry; none: the stages, or else "auto"
  std::optional<StrategyOptions> stages = {};  ///< compose a search, instead of `solver`
  std::vector<double> grid_steps = {};         ///< as SolverOptions::grid_steps
  double tolerance = SolverOptions{}.tolerance;
  double initial_step = SolverOptions{}.initial_step;

  bool operator==(const Search&) const = default;
};

/// The solver of a search. Throws UsageError when solver and stages are both given, and as
/// make_solver() and make_strategy() do.
std::unique_ptr<Solver> make_solver(const Search& search);

/// Stages as users name them: each a solver of the registry, or "none", which leaves it out. Those
/// without a name are those of "auto"; the result is none when no stage is named. Throws UsageError
/// for an empty name.
std::optional<StrategyOptions> named_stages(const std::optional<std::string>& global,
                                            const std::optional<std::string>& local,
                                            const std::optional<std::string>& polish);

/// The way back: the solver of a stage, or "none" where it is left out.
std::string stage_name(const std::string& stage);

}  // namespace nbvopt
