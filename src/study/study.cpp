#include "study/study.hpp"

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

}  // namespace nbvopt::study
