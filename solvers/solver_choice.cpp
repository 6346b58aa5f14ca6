#include "nbvopt/solver/solver_choice.hpp"

#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/registry.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt {
namespace {

constexpr const char* kDefaultSolver = "auto";
constexpr const char* kNoStage = "none";

void set_stage(std::string& stage, const std::string& which,
               const std::optional<std::string>& name) {
  if (!name) return;
  if (name->empty()) throw UsageError("the " + which + " stage is empty: name a solver or none");
  stage = *name == kNoStage ? "" : *name;
}

}  // namespace

std::unique_ptr<Solver> make_solver(const SolverChoice& choice) {
  if (!choice.global && !choice.local && !choice.polish) {
    return make_solver(choice.solver.value_or(kDefaultSolver), {.grid_steps = choice.grid_steps});
  }
  if (choice.solver) {
    throw UsageError(
        "solver names a whole search and global, local, polish compose one: give either");
  }
  StrategyOptions stages;
  set_stage(stages.global, "global", choice.global);
  set_stage(stages.local, "local", choice.local);
  set_stage(stages.polish, "polish", choice.polish);
  return make_strategy(stages);
}

}  // namespace nbvopt
