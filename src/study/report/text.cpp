#include "study/report/text.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/number.hpp"
#include "study/report/tables.hpp"

namespace nbvopt {
namespace {

using study::Evaluation;
using study::Results;

std::string count(std::size_t number, const char* one, const char* many) {
  return grouped(static_cast<double>(number)) + ' ' + (number == 1 ? one : many);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::size_t failed_runs(const Results& results) {
  return static_cast<std::size_t>(std::ranges::count_if(results.runs, &study::Run::has_failed));
}

std::size_t cases_without_reference(const Results& results) {
  return static_cast<std::size_t>(std::ranges::count_if(
      results.cases, [](const auto& one) { return std::isnan(one.reference_gain); }));
}

bool has_time_limits(const Results& results) {
  return std::ranges::any_of(results.budgets,
                             [](const auto& budget) { return budget.time_limit_ms > 0.0; });
}

std::string section(const std::string& title, const std::string& text) {
  return "\n## " + title + "\n\n" + text;
}

std::string overview(const Results& results) {
  std::set<std::string> maps;
  for (const study::CaseResult& one : results.cases) maps.insert(one.map);
  std::vector<std::string> budgets;
  for (const study::Budget& budget : results.budgets) budgets.push_back(budget_label(budget));
  return "# Study " + results.study + "\n\n" + count(results.cases.size(), "case", "cases") +
         " on " + count(maps.size(), "map", "maps") + " (" + joined({maps.begin(), maps.end()}) +
         "), " + count(results.solvers.size(), "solver", "solvers") + ", " +
         count(results.budgets.size(), "budget", "budgets") + " (" + joined(budgets) +
         "): " + count(results.runs.size(), "run", "runs") + ", of which " +
         grouped(static_cast<double>(failed_runs(results))) + " failed; " +
         grouped(static_cast<double>(results.missing_runs)) + " more are missing.\n";
}

std::string how_to_read(const Results& results, const Evaluation& evaluation) {
  const char* reference = results.against == study::Against::upper_bound
                              ? "the bound that no view of its case exceeds"
                              : "the best exact gain known for its case";
  std::string text =
      std::string("\nA ratio is the exact gain of an answer over ") + reference +
      "; a failed run counts 0. Evaluations are those of the exact gain and of the surrogate "
      "together, unless said otherwise. Unless a table says otherwise, runs are those with the "
      "loosest budget, " +
      budget_label(results.budgets[evaluation.budget]) +
      ". Columns of times, and of what is divided by them, differ from run to run of a study: "
      "in the CSV files their names end in `_ms` or `_s_wall`, here their headings say ms or a "
      "second.";
  if (has_time_limits(results)) {
    text += " With a time limit every figure depends on times.";
  }
  return text + '\n';
}

/// How far the best known answers are proved to be the best.
std::string references(const Results& results) {
  constexpr double kCertifiedGap = 0.01;
  std::vector<double> gaps;
  for (const study::CaseResult& one : results.cases) {
    if (!std::isnan(one.upper_bound)) gaps.push_back(one.gap());
  }
  if (gaps.empty()) return "";
  std::ranges::sort(gaps);
  const auto certified =
      static_cast<std::size_t>(std::ranges::upper_bound(gaps, kCertifiedGap) - gaps.begin());
  return section("References",
                 "Of " + count(gaps.size(), "reference", "references") + " " +
                     grouped(static_cast<double>(certified)) +
                     " are certified: no view in reach gains 1 % more. The best known gain is "
                     "within " +
                     decimal(100.0 * gaps[gaps.size() / 2], 2) +
                     " % of what is proved to be the most in the median case, and within " +
                     decimal(100.0 * gaps.back(), 2) + " % in the worst.\n");
}

std::string solvers(const Results& results, const Evaluation& evaluation) {
  return section("Solvers", to_markdown(main_table(results, evaluation)) +
                                "\nMeans of evaluations and times are over the runs that gave an "
                                "answer. 95 %: where the mean ratio would lie with other maps and "
                                "starts of their kind, by a bootstrap over maps and their "
                                "starts.\n");
}

std::string dense(const Results& results, const Evaluation& evaluation) {
  if (evaluation.dense.empty()) return {};
  return section("By all pixels",
                 "The same answers judged with a ray for each pixel of the camera's image, over "
                 "the best such gain of any answer to the case. The references' own views have " +
                     decimal(evaluation.dense_ratio_of_references, 4) +
                     " of it: what they have more by the rays of planning is partly luck.\n\n" +
                     to_markdown(dense_table(results, evaluation)));
}

std::string running_times(const Results& results, const Evaluation& evaluation) {
  return section(
      "Expected running time",
      to_markdown(running_time_overview(results, evaluation)) +
          "\nWhat a search costs that is started again until it reaches a share of the best gain "
          "(COCO's ERT): the cost of all runs, until they reached it or to their end, over the "
          "number of those that did. \"never\": none did. Tight budgets are left out: solvers "
          "share them out differently, so their runs are not the beginnings of longer ones.\n\n"
          "![Performance profile](performance_profile.png)\n\n"
          "Performance profile (Dolan and More): the share of cases and seeds in which a solver "
          "reaches " +
          decimal(100.0 * study::kProfileTarget, 0) +
          " % of the best gain at no more than so many times the cost of the cheapest solver "
          "there.\n\n"
          "![Runtime distribution](data_profile.png)\n\n"
          "Runtime distribution (COCO): the share of all pairs of a run and a target that are "
          "reached within a cost. The 41 targets lie between 70 and 99.9 % of the best gain.\n");
}

std::string budgets(const Results& results, const Evaluation& evaluation) {
  return section("Budgets", "The mean ratio within each budget.\n\n" +
                                to_markdown(budget_table(results, evaluation)) +
                                "\n![Gain against budget](budget.png)\n");
}

std::string cycles(const Results& results, const Evaluation& evaluation) {
  return section(
      "Gain a second",
      "The gain of all runs over the time of all, as a robot that does one after the other "
      "collects it. Moving: the time of a run is computing and the motion of the answer, as in the "
      "paper. A column a motion time.\n\n" +
          to_markdown(cycle_overview(results, evaluation, &study::Cycle::gain_per_s_moving)) +
          "\nWaiting: the time is computing and the whole motion time, of a robot that waits for "
          "the end of the time that its joints have.\n\n" +
          to_markdown(cycle_overview(results, evaluation, &study::Cycle::gain_per_s_waiting)) +
          "\nAdding: the same of what answers gain more than staying, which is what moving is "
          "worth.\n\n" +
          to_markdown(cycle_overview(results, evaluation, &study::Cycle::added_per_s_waiting)) +
          "\nThe motion time with the greatest gain a second on each map: by moving, by waiting, "
          "by adding.\n\n" +
          to_markdown(best_motion_time_overview(results, evaluation)) +
          "\n![Gain a second](cycle.png)\n");
}

std::string modes(const Results& results, const Evaluation& evaluation) {
  if (!evaluation.modes) return {};
  return section(
      "Uncertainty modes",
      "Answers of " + results.solvers.front() +
          " that were chosen by one measure of uncertainty, judged by another: their "
          "mean gain over that of the answers that the judging measure chose itself.\n\n" +
          to_markdown(modes_overview(*evaluation.modes)));
}

std::string comparisons(const Results& results, const Evaluation& evaluation) {
  if (evaluation.comparisons.empty()) return {};
  return section(
      "Against " + results.solvers.front(),
      to_markdown(comparison_table(results, evaluation)) +
          "\nWilcoxon's signed-rank test, two-sided, of the ratio, averaged over seeds, case by "
          "case against that of " +
          results.solvers.front() +
          "; equal cases are dropped. Holm's correction covers all rows. A positive difference "
          "and a positive rank-biserial correlation favour the row's solver.\n");
}

std::string caveats(const Results& results, const Evaluation& evaluation) {
  std::vector<std::string> lines;
  if (results.missing_runs > 0) {
    lines.push_back(count(results.missing_runs, "run is", "runs are") +
                    " missing; every figure is over the runs that are there.");
  }
  if (const std::size_t failed = failed_runs(results); failed > 0) {
    lines.push_back(count(failed, "run", "runs") +
                    " failed: no gain, at the time that was recorded, which is none where a worker "
                    "ended, and no evaluations.");
  }
  if (const std::size_t unknown = cases_without_reference(results); unknown > 0) {
    lines.push_back(count(unknown, "case has", "cases have") +
                    " no reference and no part in ratios, running times, profiles and tests.");
  }
  const study::Excess& excess = evaluation.excess;
  if (excess.runs > 0) {
    lines.push_back(
        count(excess.runs, "answer exceeds its reference", "answers exceed their references") +
        ", at most by " + decimal(100.0 * (excess.greatest_ratio - 1.0), 3) +
        " %: the exact gain is rough, and ratios are not cut at 1.");
  }
  if (excess.despite_no_gain > 0) {
    lines.push_back(count(excess.despite_no_gain, "answer has", "answers have") +
                    " gain where the reference has none; their ratio counts as 1.");
  }
  if (evaluation.modes) {
    lines.emplace_back("Gains a second mix uncertainty modes, whose gains have different scales.");
  }
  if (lines.empty()) return {};
  std::string text;
  for (const std::string& line : lines) text += "- " + line + '\n';
  return section("Caveats", text);
}

}  // namespace

std::string study_text(const Results& results, const Evaluation& evaluation) {
  return overview(results) + how_to_read(results, evaluation) + references(results) +
         solvers(results, evaluation) + dense(results, evaluation) +
         running_times(results, evaluation) + budgets(results, evaluation) +
         cycles(results, evaluation) + modes(results, evaluation) +
         comparisons(results, evaluation) + caveats(results, evaluation);
}

}  // namespace nbvopt
