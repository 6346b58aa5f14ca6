// How a study searches: a solver of the registry, or a strategy, with its parameters.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/planner/robot_fields.hpp"
#include "nbvopt/solver/registry.hpp"
#include "nbvopt/solver/solver.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt::study {

/// One search. Parameters count only where they belong: steps to `grid`, tolerance and initial step
/// to `nlopt:*` and `ceres:*`, stages and surrogate to `auto`.
struct Search {
  std::string solver = "auto";
  std::string evaluator = "exact";  ///< what it searches on: exact or paper-code
  double step_pan_rad = 0.8;        ///< of the paper
  double step_tilt_rad = 0.0;       ///< 0: keeps the joint
  double step_height_m = 0.0;
  double tolerance = nbvopt::Search{}.tolerance;
  double initial_step = nbvopt::Search{}.initial_step;
  StrategyOptions stages;
  /// Of the panorama; none: as the planner has it.
  std::optional<double> surrogate_ray_spacing;
  std::optional<double> surrogate_layer_spacing;
  std::optional<double> surrogate_smoothing;

  bool operator==(const Search&) const = default;
};

/// Every parameter that counts, in a fixed order; set_search() reads them back.
std::vector<FieldSetting> settings(const Search& search);

/// Writes a setting. Throws InputError that names `place`, key and value: an unknown key (with the
/// nearest right one), a value of the wrong type.
void set_search(Search& search, const FieldSetting& setting, const std::string& place);

/// Throws InputError when a parameter was given that its solver does not have; `given` are the
/// settings that made it, `place` stands for them in messages.
void check_settings(const Search& search, const std::vector<FieldSetting>& given,
                    const std::string& place);

/// Makes the solver of a search. Throws UsageError as the registry does.
using SolverFactory = std::function<std::unique_ptr<Solver>(const Search&)>;
std::unique_ptr<Solver> make_search_solver(const Search& search);

/// The panorama that the search sees.
PanoramaOptions surrogate_options(const Search& search, Counting counting);

}  // namespace nbvopt::study
