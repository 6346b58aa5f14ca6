// The options that say how to search.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/solver/search.hpp"

namespace nbvopt {

struct SolverArguments {
  std::optional<std::string> solver;  ///< none: "auto", or the stages below
  std::optional<std::string> global;  ///< as named_stages() takes it, and the next two
  std::optional<std::string> local;
  std::optional<std::string> polish;
  double step_pan_rad = 0.8;
  double step_tilt_rad = 0.0;
  double step_height_m = 0.0;
};

void add_solver_arguments(CLI::App& app, SolverArguments& arguments);

/// The search that was asked for. Throws InputError for a negative step, and as named_stages()
/// does.
Search search_of(const SolverArguments& arguments);

}  // namespace nbvopt
