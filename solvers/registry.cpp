#include "nbvopt/solver/registry.hpp"

#include <algorithm>

#include "nbvopt/core/error.hpp"
#include "solvers/families.hpp"

namespace nbvopt {
namespace {

constexpr const char* kDefaultSolver = "auto";

/// Every family; a new one is added here and nowhere else.
const std::vector<SolverFamily>& families() {
  static const std::vector<SolverFamily> kFamilies{strategy_family(), grid_family(),
                                                   random_family(), nlopt_family(), ceres_family()};
  return kFamilies;
}

/// Null for a name that is not known.
const SolverFamily* family_of(const std::string& name) {
  const auto family = std::ranges::find_if(families(), [&](const SolverFamily& candidate) {
    return std::ranges::find(candidate.names, name) != candidate.names.end();
  });
  return family == families().end() ? nullptr : &*family;
}

}  // namespace

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const SolverFamily& family : families()) {
    names.insert(names.end(), family.names.begin(), family.names.end());
  }
  return names;
}

bool heeds(const std::string& solver, SearchParameters parameters) {
  const SolverFamily* family = family_of(solver);
  return family != nullptr && family->heeds == parameters;
}

std::vector<std::string> solvers_that_heed(SearchParameters parameters) {
  std::vector<std::string> labels;
  for (const SolverFamily& family : families()) {
    if (family.heeds == parameters) labels.push_back(family.label);
  }
  return labels;
}

std::unique_ptr<Solver> make_solver(const Search& search) {
  if (search.solver && search.stages) {
    throw UsageError(
        "solver names a whole search and global, local, polish compose one: give either");
  }
  const std::string name = search.solver.value_or(kDefaultSolver);
  if (const SolverFamily* family = family_of(name)) return family->make(name, search);
  std::string known;
  for (const std::string& each : solver_names()) known += (known.empty() ? "" : ", ") + each;
  throw UsageError("solver \"" + name + "\" is not known: use one of " + known);
}

std::unique_ptr<Solver> make_solver(const std::string& name, Search parameters) {
  parameters.solver = name;
  return make_solver(parameters);
}

}  // namespace nbvopt
