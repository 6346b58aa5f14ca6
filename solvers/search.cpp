#include "nbvopt/solver/search.hpp"

#include "nbvopt/core/error.hpp"

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

std::unique_ptr<Solver> make_solver(const Search& search) {
  if (!search.stages) {
    return make_solver(search.solver.value_or(kDefaultSolver),
                       {.grid_steps = search.grid_steps,
                        .tolerance = search.tolerance,
                        .initial_step = search.initial_step});
  }
  if (search.solver) {
    throw UsageError(
        "solver names a whole search and global, local, polish compose one: give either");
  }
  return make_strategy(*search.stages);
}

std::optional<StrategyOptions> named_stages(const std::optional<std::string>& global,
                                            const std::optional<std::string>& local,
                                            const std::optional<std::string>& polish) {
  if (!global && !local && !polish) return std::nullopt;
  StrategyOptions stages;
  set_stage(stages.global, "global", global);
  set_stage(stages.local, "local", local);
  set_stage(stages.polish, "polish", polish);
  return stages;
}

std::string stage_name(const std::string& stage) { return stage.empty() ? kNoStage : stage; }

}  // namespace nbvopt
