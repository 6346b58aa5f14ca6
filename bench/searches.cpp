#include "bench/searches.hpp"

#include <algorithm>
#include <utility>

#include "bench/formatted.hpp"
#include "nbvopt/solver/registry.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt::bench {
namespace {

/// A global solver, then a local one from its best point, both on the objective itself.
class TwoStages final : public Solver {
 public:
  TwoStages(std::unique_ptr<Solver> global, std::int64_t global_evaluations,
            std::unique_ptr<Solver> local)
      : global_(std::move(global)),
        global_evaluations_(global_evaluations),
        local_(std::move(local)) {}

  std::string name() const override { return global_->name() + " + " + local_->name(); }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override {
    SolveRequest stage = request;
    stage.stop.max_evaluations = std::min(request.stop.max_evaluations, global_evaluations_);
    const SolveResult global = global_->solve(objective, stage);
    stage.start = global.best;
    stage.stop.max_evaluations = request.stop.max_evaluations - global.evaluations;
    SolveResult result = local_->solve(objective, stage);
    result.evaluations += global.evaluations;
    return result;
  }

  std::unique_ptr<Solver> global_;
  std::int64_t global_evaluations_;
  std::unique_ptr<Solver> local_;
};

void add_grids(std::vector<Search>& searches) {
  constexpr double kPaperStep_rad = 0.8;
  const std::shared_ptr<const Solver> pan_grid =
      make_solver("grid", {.grid_steps = {kPaperStep_rad, 0.0, 0.0}});
  searches.push_back({kPaperSearch, "pan grid", pan_grid, true});
  searches.push_back({"pan grid 0.8, exact", "pan grid", pan_grid});
  for (const double pan_step_rad : {0.8, 0.6, 0.4, 0.3, 0.2}) {
    // A box has about as many steps of tilt as of height.
    const double tilt_step_rad = pan_step_rad / 2.0;
    const double height_step_m = pan_step_rad / 8.0;
    searches.push_back(
        {formatted("grid %g rad, %g rad, %g m", pan_step_rad, tilt_step_rad, height_step_m),
         kJointGrid,
         make_solver("grid", {.grid_steps = {pan_step_rad, tilt_step_rad, height_step_m}})});
  }
}

void add_exact_only(std::vector<Search>& searches) {
  constexpr std::int64_t kGlobalEvaluations = 280;
  const StrategyOptions stages;
  searches.push_back({"random", "exact only", make_solver("random", {})});
  searches.push_back({"nlopt:direct-l + nlopt:sbplx, exact only", "exact only",
                      std::make_shared<TwoStages>(
                          make_solver("nlopt:direct-l", {}), kGlobalEvaluations,
                          make_solver("nlopt:sbplx", {.grid_steps = {},
                                                      .tolerance = stages.polish_tolerance,
                                                      .initial_step = stages.polish_step}))});
}

/// Auto with one stage exchanged for another solver or, where that is empty, left out.
void add_variants(std::vector<Search>& searches) {
  struct Variants {
    const char* stage;
    std::string StrategyOptions::*solver;
    std::vector<const char*> others;
  };
  const Variants all[] = {
      {"global",
       &StrategyOptions::global,
       {"", "nlopt:direct-l", "nlopt:crs2", "nlopt:esch", "nlopt:mlsl-lds"}},
      {"local",
       &StrategyOptions::local,
       {"", "nlopt:lbfgs", "nlopt:slsqp", "nlopt:mma", "ceres:lbfgs", "ceres:lm"}},
      {"polish", &StrategyOptions::polish, {"", "nlopt:cobyla", "nlopt:bobyqa", "nlopt:sbplx"}},
  };
  for (const Variants& variants : all) {
    for (const std::string other : variants.others) {
      StrategyOptions stages;
      if (stages.*variants.solver == other) continue;
      stages.*variants.solver = other;
      searches.push_back({std::string("auto, ") + (other.empty() ? "no " : "") + variants.stage +
                              (other.empty() ? "" : " " + other),
                          "strategy", make_strategy(stages)});
    }
  }
}

}  // namespace

std::vector<Search> make_searches() {
  std::vector<Search> searches;
  add_grids(searches);
  add_exact_only(searches);
  const std::shared_ptr<const Solver> automatic = make_solver("auto", {});
  searches.push_back({kAutoSearch, "auto", automatic});
  searches.push_back({"auto, 2 threads", "auto", automatic, false, 2});
  add_variants(searches);
  return searches;
}

}  // namespace nbvopt::bench
