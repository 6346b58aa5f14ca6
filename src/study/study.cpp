#include "study/study.hpp"

#include "experiment/digest.hpp"
#include "nbvopt/core/version.hpp"
#include "study/unit_message.hpp"

namespace nbvopt::study {
namespace {

std::size_t cases_per_start(const Study& study) {
  return study.motion_times_s.size() * study.modes.size();
}

std::size_t units_per_case(const Study& study) {
  return study.searches.size() * study.budgets.size() * study.seeds.size();
}

/// Takes the last digit off a number whose digits have different bases.
std::size_t take_digit(std::size_t& number, std::size_t base) {
  const std::size_t digit = number % base;
  number /= base;
  return digit;
}

}  // namespace

std::size_t case_count(const Study& study) {
  std::size_t starts = 0;
  for (const StudyMap& map : study.maps) starts += map.starts.size();
  return starts * cases_per_start(study);
}

std::size_t unit_count(const Study& study) { return case_count(study) * units_per_case(study); }

CaseIndex case_at(const Study& study, std::size_t index) {
  CaseIndex result;
  result.mode = take_digit(index, study.modes.size());
  result.motion_time = take_digit(index, study.motion_times_s.size());
  while (index >= study.maps[result.map].starts.size()) {
    index -= study.maps[result.map].starts.size();
    ++result.map;
  }
  result.start = index;
  return result;
}

UnitIndex unit_at(const Study& study, std::size_t index) {
  UnitIndex result;
  result.seed = take_digit(index, study.seeds.size());
  result.budget = take_digit(index, study.budgets.size());
  result.search = take_digit(index, study.searches.size());
  result.case_index = index;
  return result;
}

Fingerprints::Fingerprints(const Study& study)
    : study_(study), robot_(experiment::digest(version() + to_yaml(study.robot))) {}

const std::string& Fingerprints::of_case(std::size_t case_index) {
  if (last_case_ == case_index) return last_;
  const CaseIndex place = case_at(study_, case_index);
  const StudyMap& map = study_.maps[place.map];
  const Json identity{{"map", map.digest},
                      {"robot", robot_},
                      {"start", to_json(map.starts[place.start])},
                      {"motion_time_s", study_.motion_times_s[place.motion_time]},
                      {"uncertainty_mode", to_string(study_.modes[place.mode])}};
  last_ = experiment::digest(identity.dump());
  last_case_ = case_index;
  return last_;
}

std::string Fingerprints::of_unit(const UnitIndex& unit) {
  const Json identity{{"case", of_case(unit.case_index)},
                      {"search", to_json(study_.searches[unit.search].search)},
                      {"budget", to_json(study_.budgets[unit.budget])},
                      {"seed", study_.seeds[unit.seed]}};
  return experiment::digest(identity.dump());
}

}  // namespace nbvopt::study
