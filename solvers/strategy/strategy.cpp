#include "solvers/strategy/strategy.hpp"

#include <sstream>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/registry.hpp"
#include "solvers/families.hpp"
#include "solvers/strategy/strategy_search.hpp"

namespace nbvopt {
namespace {

constexpr const char* kNoStage = "none";

void set_stage(std::string& stage, const std::string& which,
               const std::optional<std::string>& name) {
  if (!name) return;
  if (name->empty()) throw UsageError("the " + which + " stage is empty: name a solver or none");
  stage = *name == kNoStage ? "" : *name;
}

void check(bool is_in_range, const char* field, double value, const char* range) {
  if (is_in_range) return;
  std::ostringstream text;
  text << field << " = " << value << ": give " << range;
  throw UsageError(text.str());
}

void check_at_least_1(const char* field, std::int64_t value) {
  check(value >= 1, field, static_cast<double>(value), "at least 1");
}

StrategyOptions checked(StrategyOptions options) {
  if (options.global.empty() && options.local.empty() && options.polish.empty()) {
    throw UsageError("strategy: every stage is left out: name a global, local or polish solver");
  }
  check(options.line_points >= 0, "line_points", options.line_points, "0 or more");
  check_at_least_1("global_evaluations", options.global_evaluations);
  check_at_least_1("local_starts", options.local_starts);
  check(options.start_separation >= 0.0 && options.start_separation <= 1.0, "start_separation",
        options.start_separation, "a share of the box's width, from 0 to 1");
  check_at_least_1("local_evaluations", options.local_evaluations);
  check_at_least_1("polish_candidates", options.polish_candidates);
  check_at_least_1("polish_evaluations", options.polish_evaluations);
  return options;
}

/// Runs a step of one stage, so that its errors name the stage.
template <typename Step>
auto in_stage(const char* stage, const Step& step) {
  try {
    return step();
  } catch (const UsageError& error) {
    throw UsageError(std::string(stage) + " stage: " + error.what());
  }
}

std::unique_ptr<Solver> make_stage(const char* stage, const std::string& name,
                                   const Search& parameters) {
  if (name.empty()) return nullptr;
  return in_stage(stage, [&] {
    if (heeds(name, SearchParameters::grid_steps)) {
      throw UsageError("solver " + name + " has no steps here: use another solver");
    }
    auto solver = make_solver(name, parameters);
    if (solver->needs().surrogate) {
      throw UsageError("solver " + name + " is a strategy itself: use another solver");
    }
    return solver;
  });
}

void check_stage(const char* stage, const Solver* solver, const Objective& objective) {
  if (solver) in_stage(stage, [&] { solver->check_needs(objective); });
}

/// The solvers' names, such as "nlopt:direct-l + nlopt:lbfgs".
std::string composed_name(const StrategyOptions& options) {
  std::string name;
  for (const std::string& stage : {options.global, options.local, options.polish}) {
    if (!stage.empty()) name += (name.empty() ? "" : " + ") + stage;
  }
  return name;
}

}  // namespace

StrategySolver::StrategySolver(std::string name, StrategyOptions options)
    : name_(std::move(name)),
      options_(checked(std::move(options))),
      stages_{make_stage("global", options_.global, {}),
              make_stage("local", options_.local, {.tolerance = options_.local_tolerance}),
              make_stage(
                  "polish", options_.polish,
                  {.tolerance = options_.polish_tolerance, .initial_step = options_.polish_step})} {
}

SolveResult StrategySolver::do_solve(const Objective& objective,
                                     const SolveRequest& request) const {
  if (needs().surrogate) {
    check_stage("global", stages_.global.get(), *objective.surrogate());
    check_stage("local", stages_.local.get(), *objective.surrogate());
  }
  check_stage("polish", stages_.polish.get(), objective);
  return StrategySearch(options_, stages_, objective, request).run();
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

std::unique_ptr<Solver> make_strategy(const StrategyOptions& options) {
  return std::make_unique<StrategySolver>(composed_name(options), options);
}

SolverFamily strategy_family() {
  return {.label = "auto",
          .names = {"auto"},
          .heeds = SearchParameters::stages,
          .make = [](const std::string& name, const Search& search) -> std::unique_ptr<Solver> {
            if (search.stages) return make_strategy(*search.stages);
            return std::make_unique<StrategySolver>(name, StrategyOptions{});
          }};
}

}  // namespace nbvopt
