// The families of solvers: each names its own, says what they heed and makes them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/solver/registry.hpp"

namespace nbvopt {

/// Solvers of one make.
struct SolverFamily {
  std::string label;  ///< of all, in messages, such as "nlopt:*"
  std::vector<std::string> names;
  std::optional<SearchParameters> heeds;  ///< none: no parameter
  /// Makes the one of that name, with what it heeds of the search.
  std::unique_ptr<Solver> (*make)(const std::string& name, const Search& search);
};

SolverFamily strategy_family();
SolverFamily grid_family();
SolverFamily random_family();
SolverFamily nlopt_family();
SolverFamily ceres_family();

}  // namespace nbvopt
