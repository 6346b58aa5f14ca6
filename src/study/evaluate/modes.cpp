#include "study/evaluate/modes.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>

#include "study/evaluate/ratio.hpp"

namespace nbvopt::study {
namespace {

/// A question without its mode, and the seed: map, start, motion time, seed.
using Question = std::tuple<std::string, std::size_t, double, std::uint64_t>;
using AnswerByMode = std::array<const Run*, 3>;

std::map<Question, AnswerByMode> answers_of_control(const Results& results) {
  std::map<Question, AnswerByMode> answers;
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.solver != 0 || run.budget != budget || run.has_failed()) continue;
    const CaseResult& one = results.cases[run.case_index];
    answers[{one.map, one.start, one.motion_time_s, run.seed}][mode_index(one.mode)] = &run;
  }
  return answers;
}

}  // namespace

std::size_t mode_index(UncertaintyMode mode) {
  switch (mode) {
    case UncertaintyMode::distance:
      return 0;
    case UncertaintyMode::angle:
      return 1;
    case UncertaintyMode::both:
      return 2;
  }
  return 2;
}

std::optional<ModeTable> compare_modes(const Results& results) {
  const auto is_of_the_first = [&](const CaseResult& one) {
    return one.mode == results.cases.front().mode;
  };
  if (std::ranges::all_of(results.cases, is_of_the_first)) return std::nullopt;
  const std::map<Question, AnswerByMode> answers = answers_of_control(results);
  ModeTable table;
  for (std::size_t chosen = 0; chosen < 3; ++chosen) {
    for (std::size_t judged = 0; judged < 3; ++judged) {
      double gain = 0.0;
      double own_gain = 0.0;
      for (const auto& [question, by_mode] : answers) {
        if (by_mode[chosen] == nullptr || by_mode[judged] == nullptr) continue;
        ++table.pairs[chosen][judged];
        gain += by_mode[chosen]->gain_by_mode[judged];
        own_gain += by_mode[judged]->gain_by_mode[judged];
      }
      table.ratio[chosen][judged] =
          own_gain > 0.0 ? gain / own_gain : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return table;
}

}  // namespace nbvopt::study
