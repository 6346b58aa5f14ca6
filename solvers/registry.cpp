#include "nbvopt/solver/registry.hpp"

#include <array>

#include "nbvopt/core/error.hpp"
#include "solvers/backends/ceres.hpp"
#include "solvers/backends/grid.hpp"
#include "solvers/backends/nlopt.hpp"
#include "solvers/backends/random.hpp"
#include "solvers/strategy/strategy.hpp"

namespace nbvopt {
namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Solver> (*make)(const std::string& name, const SolverOptions& options);
};

std::unique_ptr<Solver> make_auto(const std::string& name, const SolverOptions&) {
  return std::make_unique<StrategySolver>(name, StrategyOptions{});
}

std::unique_ptr<Solver> make_grid(const std::string&, const SolverOptions& options) {
  return std::make_unique<GridSolver>(options.grid_steps);
}

std::unique_ptr<Solver> make_random(const std::string&, const SolverOptions&) {
  return std::make_unique<RandomSolver>();
}

std::unique_ptr<Solver> make_nlopt(const std::string& name, const SolverOptions& options) {
  return std::make_unique<NloptSolver>(name, options.tolerance, options.initial_step);
}

std::unique_ptr<Solver> make_ceres_lbfgs(const std::string&, const SolverOptions& options) {
  return std::make_unique<CeresLbfgsSolver>(options.tolerance);
}

std::unique_ptr<Solver> make_ceres_lm(const std::string&, const SolverOptions& options) {
  return std::make_unique<CeresLmSolver>(options.tolerance);
}

/// Every solver; a new one is added here and nowhere else.
constexpr std::array kSolvers{
    Entry{"auto", make_auto},
    Entry{"grid", make_grid},
    Entry{"random", make_random},
    Entry{"nlopt:direct-l", make_nlopt},
    Entry{"nlopt:crs2", make_nlopt},
    Entry{"nlopt:isres", make_nlopt},
    Entry{"nlopt:esch", make_nlopt},
    Entry{"nlopt:mlsl-lds", make_nlopt},
    Entry{"nlopt:stogo", make_nlopt},
    Entry{"nlopt:ags", make_nlopt},
    Entry{"nlopt:lbfgs", make_nlopt},
    Entry{"nlopt:slsqp", make_nlopt},
    Entry{"nlopt:mma", make_nlopt},
    Entry{"nlopt:bobyqa", make_nlopt},
    Entry{"nlopt:sbplx", make_nlopt},
    Entry{"nlopt:cobyla", make_nlopt},
    Entry{"ceres:lbfgs", make_ceres_lbfgs},
    Entry{"ceres:lm", make_ceres_lm},
};

std::string known_names() {
  std::string names;
  for (const Entry& entry : kSolvers)
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

}  // namespace

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kSolvers) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Solver> make_solver(const std::string& name, const SolverOptions& options) {
  for (const Entry& entry : kSolvers) {
    if (entry.name == name) return entry.make(name, options);
  }
  throw UsageError("solver \"" + name + "\" is not known: use one of " + known_names());
}

}  // namespace nbvopt
