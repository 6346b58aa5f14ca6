// The solver behind make_strategy().
#pragma once

#include <memory>
#include <string>

#include "nbvopt/solver/strategy.hpp"

namespace nbvopt {

/// The solvers of a strategy's stages; null where a stage is left out.
struct StrategyStages {
  std::unique_ptr<Solver> global;
  std::unique_ptr<Solver> local;
  std::unique_ptr<Solver> polish;
};

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
