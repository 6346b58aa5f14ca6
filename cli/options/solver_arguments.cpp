#include "cli/options/solver_arguments.hpp"

#include <CLI/Option.hpp>

#include "cli/options/arguments.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt {
namespace {

void check_step(const std::string& option, double step, const std::string& unit) {
  if (step >= 0.0) return;
  throw InputError(option + " is " + format_number(step) + unit +
                   ", it must be 0 (keeps the joint) or more");
}

}  // namespace

void add_solver_arguments(CLI::App& app, SolverArguments& arguments) {
  app.add_option("--solver", arguments.solver, "how to search")
      ->type_name("NAME")
      ->default_str("auto");
  const StrategyOptions stages;
  const auto add_stage = [&app](const char* name, std::optional<std::string>& target,
                                const std::string& stage, const char* description) {
    app.add_option(name, target, description)->type_name("NAME")->default_str(stage);
  };
  add_stage("--global", arguments.global, stages.global,
            "compose a search: the stage that looks everywhere on the surrogate, or none");
  add_stage("--local", arguments.local, stages.local,
            "compose a search: the stage that climbs from there on the surrogate, or none");
  add_stage("--polish", arguments.polish, stages.polish,
            "compose a search: the last stage, on the gain itself, or none");
  add_number(app, "--step-pan", arguments.step_pan_rad, "RAD", "of grid; 0 keeps the pan");
  add_number(app, "--step-tilt", arguments.step_tilt_rad, "RAD", "of grid; 0 keeps the tilt");
  add_number(app, "--step-height", arguments.step_height_m, "M", "of grid; 0 keeps the height");
}

Search search_of(const SolverArguments& arguments) {
  check_step("--step-pan", arguments.step_pan_rad, " rad");
  check_step("--step-tilt", arguments.step_tilt_rad, " rad");
  check_step("--step-height", arguments.step_height_m, " m");
  return {.solver = arguments.solver,
          .stages = named_stages(arguments.global, arguments.local, arguments.polish),
          .grid_steps = {arguments.step_pan_rad, arguments.step_tilt_rad, arguments.step_height_m}};
}

}  // namespace nbvopt
