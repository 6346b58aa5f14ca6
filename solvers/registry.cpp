#include "nbvopt/solver/registry.hpp"

#include <array>

#include "grid.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

struct Entry {
  const char* name;
  std::unique_ptr<Solver> (*make)(const SolverOptions& options);
};

std::unique_ptr<Solver> make_grid(const SolverOptions& options) {
  return std::make_unique<GridSolver>(options.grid_steps);
}

/// Every solver; a new one is added here and nowhere else.
constexpr std::array kSolvers{
    Entry{"grid", make_grid},
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
    if (entry.name == name) return entry.make(options);
  }
  throw UsageError("solver \"" + name + "\" is not known: use one of " + known_names());
}

}  // namespace nbvopt
