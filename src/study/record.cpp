#include "study/record.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "experiment/record_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::study {
namespace {

/// Who asked what.
Json case_json(const Study& study, std::size_t case_index) {
  const CaseIndex place = case_at(study, case_index);
  const StudyMap& map = study.maps[place.map];
  return {{"map", map.name},
          {"start_index", place.start},
          {"start", to_json(map.starts[place.start])},
          {"motion_time_s", study.motion_times_s[place.motion_time]},
          {"uncertainty_mode", to_string(study.modes[place.mode])}};
}

void add_outcome(Json& record, const experiment::Outcome& outcome) {
  if (outcome.failure.empty()) {
    record.update(outcome.answer);
  } else {
    record["failure"] = outcome.failure;
    record["times"] = {{"search_ms", outcome.busy_ms}};
  }
}

std::vector<ProgressStep> progress_of(const Json& record) {
  const Json& progress = record.at("progress");
  const auto evaluations = progress.at("evaluations").get<std::vector<std::int64_t>>();
  const auto exact = progress.at("exact_evaluations").get<std::vector<std::int64_t>>();
  const auto gains = progress.at("gain").get<std::vector<double>>();
  const auto times_ms = record.at("times").at("progress_ms").get<std::vector<double>>();
  std::vector<ProgressStep> steps(
      std::min({evaluations.size(), exact.size(), gains.size(), times_ms.size()}));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = {evaluations[i], exact[i], times_ms[i], gains[i]};
  }
  return steps;
}

Run run_of(const Json& record, const UnitIndex& unit, std::uint64_t seed) {
  Run run;
  run.case_index = unit.case_index;
  run.solver = unit.search;
  run.budget = unit.budget;
  run.seed = seed;
  run.failure = record.value("failure", "");
  run.search_time_ms = record.at("times").at("search_ms").get<double>();
  if (run.has_failed()) return run;
  run.gain = record.at("gain").get<double>();
  run.current_gain = record.at("current_gain").get<double>();
  const Json& by_mode = record.at("gain_by_mode");
  run.gain_by_mode = {by_mode.at("distance").get<double>(), by_mode.at("angle").get<double>(),
                      by_mode.at("both").get<double>()};
  run.dense_gain = record.value("dense_gain", run.dense_gain);  // older records have none
  run.evaluations = record.at("evaluations").get<std::int64_t>();
  run.surrogate_evaluations = record.at("surrogate_evaluations").get<std::int64_t>();
  run.move_time_s = record.at("move_time_s").get<double>();
  run.progress = progress_of(record);
  return run;
}

void read_runs(const Study& study, const StudyFolder& folder, Results& results) {
  Fingerprints fingerprints(study);
  const std::size_t count = unit_count(study);
  std::unordered_map<std::string, std::size_t> unit_of_id;
  for (std::size_t i = 0; i < count; ++i) {
    unit_of_id.emplace(fingerprints.of_unit(unit_at(study, i)), i);
  }
  std::vector<std::optional<Run>> runs(count);
  experiment::for_each_record(folder.records(), [&](const Json& record) {
    const auto unit = unit_of_id.find(record_id(record));
    if (unit == unit_of_id.end()) return;
    const UnitIndex place = unit_at(study, unit->second);
    runs[unit->second] = run_of(record, place, study.seeds[place.seed]);
  });
  for (std::optional<Run>& run : runs) {
    if (run) results.runs.push_back(std::move(*run));
  }
  results.missing_runs = count - results.runs.size();
}

void read_cases(const Study& study, const StudyFolder& folder, Results& results) {
  Fingerprints fingerprints(study);
  std::unordered_map<std::string, std::size_t> case_of_id;
  for (std::size_t i = 0; i < case_count(study); ++i) {
    const CaseIndex place = case_at(study, i);
    results.cases.push_back({.map = study.maps[place.map].name,
                             .start = place.start,
                             .motion_time_s = study.motion_times_s[place.motion_time],
                             .mode = study.modes[place.mode]});
    case_of_id.emplace(fingerprints.of_case(i), i);
  }
  experiment::for_each_record(folder.references(), [&](const Json& record) {
    const auto known = case_of_id.find(record_id(record));
    if (known == case_of_id.end() || record.contains("failure")) return;
    CaseResult& one = results.cases[known->second];
    one.best_known = record.at("gain").get<double>();
    one.upper_bound = record.value("upper_bound", one.upper_bound);  // older records have none,
    one.dense_gain = record.value("dense_gain", one.dense_gain);     // nor this
    one.reference_gain = results.against == Against::upper_bound ? one.upper_bound : one.best_known;
  });
}

}  // namespace

Json query_record(const Study& study, const UnitIndex& unit, Fingerprints& fingerprints,
                  const experiment::Outcome& outcome) {
  Json record{{"schema", kRecordVersion},
              {"unit", fingerprints.of_unit(unit)},
              {"case", fingerprints.of_case(unit.case_index)}};
  record.update(case_json(study, unit.case_index));
  record["search"] = study.searches[unit.search].label;
  record.update(to_json(study.budgets[unit.budget]));
  record["seed"] = study.seeds[unit.seed];
  add_outcome(record, outcome);
  return record;
}

Json reference_record(const Study& study, std::size_t case_index, Fingerprints& fingerprints,
                      const experiment::Outcome& outcome) {
  Json record{{"schema", kRecordVersion}, {"case", fingerprints.of_case(case_index)}};
  record.update(case_json(study, case_index));
  add_outcome(record, outcome);
  return record;
}

std::string record_id(const Json& record) {
  if (record.at("schema") != kRecordVersion) {
    throw InputError("a record has schema " + record.at("schema").dump() + ", this program reads " +
                     std::to_string(kRecordVersion));
  }
  return record.at(record.contains("unit") ? "unit" : "case").get<std::string>();
}

Results read_results(const Study& study, const StudyFolder& folder, Against against) {
  Results results;
  results.study = study.name;
  results.budgets = study.budgets;
  for (const NamedSearch& named : study.searches) results.solvers.push_back(named.label);
  results.against = against;
  read_cases(study, folder, results);
  read_runs(study, folder, results);
  return results;
}

}  // namespace nbvopt::study
