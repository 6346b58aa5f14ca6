// A search as studies have it: what it searches on besides, and its parameters by name.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/fields/field_value.hpp"
#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/sensor/gain_choice.hpp"
#include "nbvopt/solver/search.hpp"

namespace nbvopt::study {

/// A search, and what it sees.
struct StudySearch {
  Search search{.grid_steps = {0.8, 0.0, 0.0}};  ///< pan (rad, of the paper), tilt, height (m)
  std::string evaluator = "exact";               ///< exact or paper-code
  /// What it searches for; its answers are judged by the robot's gain. None: that one.
  std::optional<GainChoice> gain = {};
  /// Of the panorama that strategies search on; none: as the planner has it.
  std::optional<double> surrogate_ray_spacing = {};
  std::optional<double> surrogate_layer_spacing = {};
  std::optional<double> surrogate_smoothing = {};
};

/// Every parameter that its solver heeds, in a fixed order; set_search() reads them back. What has
/// the same settings is the same search.
std::vector<FieldSetting> settings(const StudySearch& search);

/// The keys of all parameters.
std::vector<std::string> search_keys();

/// Writes a setting. Throws InputError that names `place`, key and value: an unknown key (with the
/// nearest right one), a value of the wrong type.
void set_search(StudySearch& search, const FieldSetting& setting, const std::string& place);

/// Throws InputError when a parameter was given that its solver does not have; `given` are the
/// settings that made it, `place` stands for them in messages.
void check_settings(const StudySearch& search, const std::vector<FieldSetting>& given,
                    const std::string& place);

/// The name of its solver, or "auto".
std::string solver_of(const StudySearch& search);

/// Makes the solver of a search, as make_solver() does. Throws UsageError as it does.
using SolverFactory = std::function<std::unique_ptr<Solver>(const Search&)>;

/// The panorama that the search sees.
PanoramaOptions surrogate_options(const StudySearch& search, Counting counting);

}  // namespace nbvopt::study
