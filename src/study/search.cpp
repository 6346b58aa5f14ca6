#include "study/search.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/edit_distance.hpp"
#include "fields/field_table.hpp"
#include "fields/keys.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/solver/registry.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt::study {
namespace {

constexpr const char* kStrategy = "auto";

/// "auto" is what a search without a solver's name is: the stages belong to it.
constexpr Field<StudySearch> kSolver{
    .key = "solver",
    .comment = {},
    .get = [](const StudySearch& search) { return value_of(solver_of(search)); },
    .set =
        [](StudySearch& search, const FieldValue& value) {
          std::string name;
          std::string demand = store(value, name);
          if (!demand.empty()) return demand;
          search.search.solver.reset();
          if (name != kStrategy) search.search.solver = name;
          return demand;
        }};

/// A stage's solver, "none" where it is left out.
template <std::string StrategyOptions::*Stage>
constexpr Field<StudySearch> stage_field(std::string_view key) {
  return {
      .key = key,
      .comment = {},
      .get =
          [](const StudySearch& search) {
            return value_of(stage_name(search.search.stages.value_or(StrategyOptions{}).*Stage));
          },
      .set =
          [](StudySearch& search, const FieldValue& value) {
            std::string name;
            std::string demand = store(value, name);
            if (!demand.empty()) return demand;
            if (!search.search.stages) search.search.stages.emplace();
            (*search.search.stages).*Stage = name == stage_name({}) ? "" : name;
            return demand;
          }};
}

template <auto Parameter>
constexpr Field<StudySearch> strategy_field(std::string_view key) {
  return field<&StudySearch::search, &Search::stages, Parameter>(key);
}

template <std::size_t Joint>
constexpr Field<StudySearch> step_field(std::string_view key) {
  return field<&StudySearch::search, &Search::grid_steps, Joint>(key);
}

constexpr std::array kCommonFields{kSolver, field<&StudySearch::evaluator>("evaluator"),
                                   field<&StudySearch::gain>("gain")};
constexpr std::array kStageFields{
    stage_field<&StrategyOptions::global>("global"),
    stage_field<&StrategyOptions::local>("local"),
    stage_field<&StrategyOptions::polish>("polish"),
    strategy_field<&StrategyOptions::line_points>("line_points"),
    strategy_field<&StrategyOptions::global_evaluations>("global_evaluations"),
    strategy_field<&StrategyOptions::local_starts>("local_starts"),
    strategy_field<&StrategyOptions::start_separation>("start_separation"),
    strategy_field<&StrategyOptions::local_tolerance>("local_tolerance"),
    strategy_field<&StrategyOptions::local_evaluations>("local_evaluations"),
    strategy_field<&StrategyOptions::polish_candidates>("polish_candidates"),
    strategy_field<&StrategyOptions::polish_tolerance>("polish_tolerance"),
    strategy_field<&StrategyOptions::polish_step>("polish_step"),
    strategy_field<&StrategyOptions::polish_evaluations>("polish_evaluations"),
    field<&StudySearch::surrogate_ray_spacing>("surrogate_ray_spacing"),
    field<&StudySearch::surrogate_layer_spacing>("surrogate_layer_spacing"),
    field<&StudySearch::surrogate_smoothing>("surrogate_smoothing")};
constexpr std::array kGridFields{step_field<0>("step_pan_rad"), step_field<1>("step_tilt_rad"),
                                 step_field<2>("step_height_m")};
constexpr std::array kToleranceFields{
    field<&StudySearch::search, &Search::tolerance>("tolerance"),
    field<&StudySearch::search, &Search::initial_step>("initial_step")};

/// Parameters that count for the solvers that heed them.
struct Part {
  std::optional<SearchParameters> heeded;  ///< none: all solvers do
  std::span<const Field<StudySearch>> fields;

  bool counts_for(const StudySearch& search) const {
    return !heeded || heeds(solver_of(search), *heeded);
  }
};

const std::array kParts{Part{std::nullopt, kCommonFields},
                        Part{SearchParameters::stages, kStageFields},
                        Part{SearchParameters::grid_steps, kGridFields},
                        Part{SearchParameters::tolerances, kToleranceFields}};

/// One that is not is refused when it is made.
bool is_known(const std::string& solver) {
  const std::vector<std::string> names = solver_names();
  return std::ranges::find(names, solver) != names.end();
}

/// Such as "solvers nlopt:* and ceres:*".
std::string owners(SearchParameters parameters) {
  const std::vector<std::string> labels = solvers_that_heed(parameters);
  std::string text = labels.size() == 1 ? "solver " : "solvers ";
  for (std::size_t i = 0; i < labels.size(); ++i) text += (i == 0 ? "" : " and ") + labels[i];
  return text;
}

}  // namespace

std::vector<FieldSetting> settings(const StudySearch& search) {
  std::vector<FieldSetting> result;
  for (const Part& part : kParts) {
    if (!part.counts_for(search)) continue;
    for (const Field<StudySearch>& field : part.fields) {
      if (const auto value = field.get(search)) result.push_back({std::string(field.key), *value});
    }
  }
  return result;
}

std::vector<std::string> search_keys() {
  std::vector<std::string> keys;
  for (const Part& part : kParts) {
    for (const Field<StudySearch>& field : part.fields) keys.emplace_back(field.key);
  }
  return keys;
}

void set_search(StudySearch& search, const FieldSetting& setting, const std::string& place) {
  for (const Part& part : kParts) {
    if (const auto* field = find_field(part.fields, setting.key)) {
      return set_field(search, *field, setting.value, place + ": " + setting.key);
    }
  }
  refuse_key(setting.key, place, search_keys());
}

void check_settings(const StudySearch& search, const std::vector<FieldSetting>& given,
                    const std::string& place) {
  const std::string solver = solver_of(search);
  for (const Part& part : kParts) {
    if (part.counts_for(search) || !is_known(solver)) continue;
    for (const FieldSetting& setting : given) {
      if (find_field(part.fields, setting.key) == nullptr) continue;
      throw InputError(place + ": " + setting.key + " belongs to " + owners(*part.heeded) +
                       ", not to " + solver);
    }
  }
  const std::vector<std::string> evaluators = evaluator_names();
  if (std::ranges::find(evaluators, search.evaluator) == evaluators.end()) {
    throw InputError(place + ": evaluator is '" + search.evaluator + "', did you mean '" +
                     nearest_word(search.evaluator, evaluators) + "'?");
  }
  if (search.gain && search.evaluator != evaluators.front()) {
    throw InputError(place + ": gain belongs to evaluator " + evaluators.front() + ", not to " +
                     search.evaluator);
  }
}

std::string solver_of(const StudySearch& search) {
  return search.search.solver.value_or(kStrategy);
}

PanoramaOptions surrogate_options(const StudySearch& search, Counting counting) {
  PanoramaOptions options = planning_panorama(counting);
  options.ray_spacing = search.surrogate_ray_spacing.value_or(options.ray_spacing);
  options.layer_spacing = search.surrogate_layer_spacing.value_or(options.layer_spacing);
  options.smoothing = search.surrogate_smoothing.value_or(options.smoothing);
  return options;
}

}  // namespace nbvopt::study
