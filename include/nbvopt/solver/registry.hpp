// The solvers by name, and what each heeds.
#pragma once

#include <string>
#include <vector>

#include "nbvopt/solver/search.hpp"

namespace nbvopt {

std::vector<std::string> solver_names();

/// The parameters of a search, as solvers heed them: one kind a solver, if any.
enum class SearchParameters {
  grid_steps,
  tolerances,  ///< tolerance and initial_step
  stages,
};

/// Whether they count for this solver; false for a name that is not known.
bool heeds(const std::string& solver, SearchParameters parameters);

/// The solvers that heed them, such as "nlopt:*" for all of a family.
std::vector<std::string> solvers_that_heed(SearchParameters parameters);

}  // namespace nbvopt
