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

/// Which searches a parameter belongs to.
enum class Part { all, grid, solver, stages };

constexpr const char* kStrategy = "auto";
constexpr const char* kGrid = "grid";
constexpr const char* kNoStage = "none";

/// Calls visit(key, field, part) for every parameter, in the order of settings().
template <class SearchOrConst, class Visit>
void for_each_parameter(SearchOrConst& s, Visit&& visit) {
  visit("solver", s.solver, Part::all);
  visit("evaluator", s.evaluator, Part::all);
  visit("step_pan_rad", s.step_pan_rad, Part::grid);
  visit("step_tilt_rad", s.step_tilt_rad, Part::grid);
  visit("step_height_m", s.step_height_m, Part::grid);
  visit("tolerance", s.tolerance, Part::solver);
  visit("initial_step", s.initial_step, Part::solver);
  visit("global", s.stages.global, Part::stages);
  visit("local", s.stages.local, Part::stages);
  visit("polish", s.stages.polish, Part::stages);
  visit("line_points", s.stages.line_points, Part::stages);
  visit("global_evaluations", s.stages.global_evaluations, Part::stages);
  visit("local_starts", s.stages.local_starts, Part::stages);
  visit("start_separation", s.stages.start_separation, Part::stages);
  visit("local_tolerance", s.stages.local_tolerance, Part::stages);
  visit("local_evaluations", s.stages.local_evaluations, Part::stages);
  visit("polish_candidates", s.stages.polish_candidates, Part::stages);
  visit("polish_tolerance", s.stages.polish_tolerance, Part::stages);
  visit("polish_step", s.stages.polish_step, Part::stages);
  visit("polish_evaluations", s.stages.polish_evaluations, Part::stages);
  visit("surrogate_ray_spacing", s.surrogate_ray_spacing, Part::stages);
  visit("surrogate_layer_spacing", s.surrogate_layer_spacing, Part::stages);
  visit("surrogate_smoothing", s.surrogate_smoothing, Part::stages);
}

bool belongs(Part part, const Search& search) {
  switch (part) {
    case Part::all:
      return true;
    case Part::grid:
      return search.solver == kGrid;
    case Part::solver:
      return search.solver.starts_with("nlopt:") || search.solver.starts_with("ceres:");
    case Part::stages:
      return search.solver == kStrategy;
  }
  return false;
}

const char* owner(Part part) {
  switch (part) {
    case Part::grid:
      return "solver grid";
    case Part::solver:
      return "solvers nlopt:* and ceres:*";
    default:
      return "solver auto";
  }
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
      if (part == Part::stages && field == kNoStage) field.clear();
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
    if (belongs(part, search) || std::ranges::find(given, key, &FieldSetting::key) == given.end()) {
      return;
    }
    throw InputError(place + ": " + key + " belongs to " + owner(part) + ", not to " +
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
