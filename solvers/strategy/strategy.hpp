// The solver behind make_strategy().
#pragma once

#include <string>

#include "nbvopt/solver/strategy.hpp"
#include "solvers/strategy/strategy_search.hpp"

namespace nbvopt {

class StrategySolver final : public Solver {
 public:
  /// Throws what make_strategy() throws.
  StrategySolver(std::string name, StrategyOptions options);

  std::string name() const override { return name_; }
  SolverNeeds needs() const override { return {.surrogate = stages_.global || stages_.local}; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  std::string name_;
  StrategyOptions options_;
  StrategyStages stages_;
};

}  // namespace nbvopt
