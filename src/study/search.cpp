#include "study/search.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/edit_distance.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "nbvopt/planner/planner.hpp"
#include "planner/field_value.hpp"

namespace nbvopt::study {
namespace {

constexpr const char* kStrategy = "auto";
constexpr const char* kNoStage = "none";

/// What a solver must heed for a parameter to count; none: it counts for all.
using Part = std::optional<SearchParameters>;

/// Calls visit(key, field, part) for every parameter, in the order of settings().
template <class SearchOrConst, class Visit>
void for_each_parameter(SearchOrConst& s, Visit&& visit) {
  visit("solver", s.solver, Part());
  visit("evaluator", s.evaluator, Part());
  visit("step_pan_rad", s.step_pan_rad, SearchParameters::grid_steps);
  visit("step_tilt_rad", s.step_tilt_rad, SearchParameters::grid_steps);
  visit("step_height_m", s.step_height_m, SearchParameters::grid_steps);
  visit("tolerance", s.tolerance, SearchParameters::tolerances);
  visit("initial_step", s.initial_step, SearchParameters::tolerances);
  visit("global", s.stages.global, SearchParameters::stages);
  visit("local", s.stages.local, SearchParameters::stages);
  visit("polish", s.stages.polish, SearchParameters::stages);
  visit("line_points", s.stages.line_points, SearchParameters::stages);
  visit("global_evaluations", s.stages.global_evaluations, SearchParameters::stages);
  visit("local_starts", s.stages.local_starts, SearchParameters::stages);
  visit("start_separation", s.stages.start_separation, SearchParameters::stages);
  visit("local_tolerance", s.stages.local_tolerance, SearchParameters::stages);
  visit("local_evaluations", s.stages.local_evaluations, SearchParameters::stages);
  visit("polish_candidates", s.stages.polish_candidates, SearchParameters::stages);
  visit("polish_tolerance", s.stages.polish_tolerance, SearchParameters::stages);
  visit("polish_step", s.stages.polish_step, SearchParameters::stages);
  visit("polish_evaluations", s.stages.polish_evaluations, SearchParameters::stages);
  visit("surrogate_ray_spacing", s.surrogate_ray_spacing, SearchParameters::stages);
  visit("surrogate_layer_spacing", s.surrogate_layer_spacing, SearchParameters::stages);
  visit("surrogate_smoothing", s.surrogate_smoothing, SearchParameters::stages);
}

bool belongs(Part part, const Search& search) { return !part || heeds(search.solver, *part); }

/// One that is not is refused when it is made.
bool is_known(const std::string& solver) {
  const std::vector<std::string> names = solver_names();
  return std::ranges::find(names, solver) != names.end();
}

/// Such as "solvers nlopt:* and ceres:*".
std::string owners(SearchParameters part) {
  const std::vector<std::string> labels = solvers_that_heed(part);
  std::string text = labels.size() == 1 ? "solver " : "solvers ";
  for (std::size_t i = 0; i < labels.size(); ++i) text += (i == 0 ? "" : " and ") + labels[i];
  return text;
}

std::string store_field(const FieldValue& value, std::optional<double>& field) {
  double number = 0.0;
  std::string demand = store(value, number);
  if (demand.empty()) field = number;
  return demand;
}

template <class Field>
std::string store_field(const FieldValue& value, Field& field) {
  return store(value, field);
}

}  // namespace

std::vector<FieldSetting> settings(const Search& search) {
  std::vector<FieldSetting> result;
  for_each_parameter(search, [&](const char* key, const auto& field, Part part) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if (!belongs(part, search)) return;
    if constexpr (std::is_same_v<Field, std::optional<double>>) {
      if (field) result.push_back({key, *field});
    } else if constexpr (std::is_same_v<Field, std::string>) {
      result.push_back({key, field.empty() ? std::string(kNoStage) : field});
    } else {
      result.push_back({key, static_cast<double>(field)});
    }
  });
  return result;
}

void set_search(Search& search, const FieldSetting& setting, const std::string& place) {
  std::vector<std::string> keys;
  std::optional<std::string> demand;
  for_each_parameter(search, [&](const char* key, auto& field, Part part) {
    keys.emplace_back(key);
    if (setting.key != key) return;
    demand = store_field(setting.value, field);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, std::string>) {
      if (part == SearchParameters::stages && field == kNoStage) field.clear();
    }
  });
  if (!demand) {
    throw InputError(place + ": unknown key '" + setting.key + "', did you mean '" +
                     nearest_word(setting.key, keys) + "'?");
  }
  if (!demand->empty()) {
    throw InputError(place + ": " + setting.key + " is " + to_text(setting.value) +
                     ", it must be " + *demand);
  }
}

void check_settings(const Search& search, const std::vector<FieldSetting>& given,
                    const std::string& place) {
  for_each_parameter(search, [&](const char* key, const auto&, Part part) {
    if (belongs(part, search) || !is_known(search.solver) ||
        std::ranges::find(given, key, &FieldSetting::key) == given.end()) {
      return;
    }
    throw InputError(place + ": " + key + " belongs to " + owners(*part) + ", not to " +
                     search.solver);
  });
  const std::vector<std::string> evaluators = evaluator_names();
  if (std::ranges::find(evaluators, search.evaluator) == evaluators.end()) {
    throw InputError(place + ": evaluator is '" + search.evaluator + "', did you mean '" +
                     nearest_word(search.evaluator, evaluators) + "'?");
  }
}

std::unique_ptr<Solver> make_search_solver(const Search& search) {
  if (search.solver == kStrategy) return make_strategy(search.stages);
  return make_solver(search.solver, {.grid_steps = {search.step_pan_rad, search.step_tilt_rad,
                                                    search.step_height_m},
                                     .tolerance = search.tolerance,
                                     .initial_step = search.initial_step});
}

PanoramaOptions surrogate_options(const Search& search, Counting counting) {
  PanoramaOptions options = planning_panorama(counting);
  options.ray_spacing = search.surrogate_ray_spacing.value_or(options.ray_spacing);
  options.layer_spacing = search.surrogate_layer_spacing.value_or(options.layer_spacing);
  options.smoothing = search.surrogate_smoothing.value_or(options.smoothing);
  return options;
}

}  // namespace nbvopt::study
