// A search as users name it: one solver, or the stages of a strategy.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

struct SolverChoice {
  std::optional<std::string> solver = {};  ///< none: "auto", or the stages below
  std::optional<std::string> global =
      {};  ///< of StrategyOptions, "none" for no stage; none: as in auto
  std::optional<std::string> local = {};
  std::optional<std::string> polish = {};
  std::vector<double> grid_steps = {};  ///< as SolverOptions::grid_steps

  bool operator==(const SolverChoice&) const = default;
};

/// The solver that was chosen. Throws UsageError when it is not known or named in two ways, and as
/// make_solver() and make_strategy() do.
std::unique_ptr<Solver> make_solver(const SolverChoice& choice);

}  // namespace nbvopt
