#include "study/report/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/number.hpp"

namespace nbvopt {
namespace {

using study::Evaluation;
using study::Results;

constexpr std::array kModes{"distance", "angle", "both"};

double number(std::size_t value) { return static_cast<double>(value); }

std::string two_digits(double value) { return decimal(value, 2); }
std::string ratio_digits(double value) { return decimal(value, 4); }
std::string difference_digits(double value) { return decimal(value, 5); }

std::string milliseconds(double value) {
  if (value >= 1000.0) return grouped(value);
  return decimal(value, value < 10.0 ? 2 : 1);
}

std::string interval_text(const study::Interval& interval) {
  if (std::isnan(interval.low)) return "-";
  return ratio_digits(interval.low) + " to " + ratio_digits(interval.high);
}

TextTable solver_rows(const Results& results) {
  TextTable table{{{"solver", "solver"}}, {}};
  for (const std::string& solver : results.solvers) table.rows.push_back({solver});
  return table;
}

/// Key of a budget's column; it ends in _ms where its figures depend on times.
std::string budget_key(const study::Budget& budget) {
  std::string key = "mean_ratio";
  if (budget.max_evaluations > 0) {
    key += '_' + std::to_string(budget.max_evaluations) + "_evaluations";
  }
  if (budget.time_limit_ms > 0.0) key += '_' + format_number(budget.time_limit_ms) + "_ms";
  return key == "mean_ratio" ? "mean_ratio_no_limit" : key;
}

/// Costs equally spaced in logarithm over all that occur.
std::vector<double> cost_grid(const std::vector<study::SolverProfiles>& profiles,
                              study::Profile study::SolverProfiles::*unit) {
  constexpr int kSteps = 100;
  const auto [least, most] = study::cost_range(profiles, unit);
  std::vector<double> grid;
  for (int i = 0; i < kSteps; ++i) {
    grid.push_back(least * std::pow(most / least, i / double{kSteps}));
  }
  grid.push_back(most);
  return grid;
}

}  // namespace

std::string budget_label(const study::Budget& budget) {
  std::string label;
  if (budget.max_evaluations > 0) {
    label = grouped(static_cast<double>(budget.max_evaluations)) + " evaluations";
  }
  if (budget.time_limit_ms > 0.0) {
    label += (label.empty() ? "" : " and ") + format_number(budget.time_limit_ms) + " ms";
  }
  return label.empty() ? "no limit" : label;
}

std::string motion_time_label(double motion_time_s) {
  return motion_time_s > 0.0 ? format_number(motion_time_s) + " s" : "no limit";
}

TextTable summary_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", ""},
                   {"max_evaluations", ""},
                   {"time_limit_ms", ""},
                   {"runs", ""},
                   {"failures", ""},
                   {"mean_ratio", ""},
                   {"mean_ratio_low", ""},
                   {"mean_ratio_high", ""},
                   {"median_ratio", ""},
                   {"worst_ratio", ""},
                   {"mean_exact_evaluations", ""},
                   {"mean_surrogate_evaluations", ""},
                   {"mean_search_time_ms", ""},
                   {"p99_search_time_ms", ""}},
                  {}};
  for (const study::Summary& row : evaluation.summaries) {
    const study::Budget& budget = results.budgets[row.budget];
    table.rows.push_back({results.solvers[row.solver], static_cast<double>(budget.max_evaluations),
                          budget.time_limit_ms, number(row.runs), number(row.failures),
                          row.mean_ratio, row.mean_ratio_interval.low, row.mean_ratio_interval.high,
                          row.median_ratio, row.worst_ratio, row.mean_exact_evaluations,
                          row.mean_surrogate_evaluations, row.mean_search_time_ms,
                          row.p99_search_time_ms});
  }
  return table;
}

TextTable main_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"", "solver"},
                   {"", "runs"},
                   {"", "failed"},
                   {"", "mean ratio", ratio_digits},
                   {"", "95 %"},
                   {"", "median", ratio_digits},
                   {"", "worst", ratio_digits},
                   {"", "exact evaluations"},
                   {"", "surrogate evaluations"},
                   {"", "time (ms)", milliseconds},
                   {"", "99th percentile (ms)", milliseconds}},
                  {}};
  for (const study::Summary& row : evaluation.summaries) {
    if (row.budget != evaluation.budget) continue;
    table.rows.push_back({results.solvers[row.solver], number(row.runs), number(row.failures),
                          row.mean_ratio, interval_text(row.mean_ratio_interval), row.median_ratio,
                          row.worst_ratio, row.mean_exact_evaluations,
                          row.mean_surrogate_evaluations, row.mean_search_time_ms,
                          row.p99_search_time_ms});
  }
  return table;
}

TextTable dense_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", "solver"},
                   {"runs", "runs"},
                   {"mean_ratio", "mean ratio", ratio_digits},
                   {"mean_ratio_low", "95 %: from", ratio_digits},
                   {"mean_ratio_high", "to", ratio_digits},
                   {"worst_ratio", "worst", ratio_digits}},
                  {}};
  for (const study::DenseSummary& row : evaluation.dense) {
    table.rows.push_back({results.solvers[row.solver], number(row.runs), row.mean_ratio,
                          row.mean_interval.low, row.mean_interval.high, row.worst_ratio});
  }
  return table;
}

TextTable budget_table(const Results& results, const Evaluation& evaluation) {
  TextTable table = solver_rows(results);
  for (const study::Budget& budget : results.budgets) {
    table.columns.push_back({budget_key(budget), budget_label(budget), ratio_digits});
  }
  for (const study::Summary& row : evaluation.summaries) {
    table.rows[row.solver].emplace_back(row.mean_ratio);
  }
  return table;
}

TextTable running_time_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", ""},
                   {"target_ratio", ""},
                   {"runs", ""},
                   {"successes", ""},
                   {"ert_evaluations", ""},
                   {"ert_ms", ""}},
                  {}};
  for (const study::ExpectedRunningTime& row : evaluation.running_times) {
    table.rows.push_back({results.solvers[row.solver], row.target, number(row.runs),
                          number(row.successes), row.expected.evaluations, row.expected.time_ms});
  }
  return table;
}

TextTable running_time_overview(const Results& results, const Evaluation& evaluation) {
  TextTable table = solver_rows(results);
  for (const study::ExpectedRunningTime& row : evaluation.running_times) {
    if (row.solver == 0) {
      const std::string target = format_number(100.0 * row.target) + " %";
      table.columns.push_back({"", target + ": reached", ratio_digits});
      table.columns.push_back({"", "evaluations"});
      table.columns.push_back({"", "ms", milliseconds});
    }
    std::vector<TableCell>& cells = table.rows[row.solver];
    cells.emplace_back(number(row.successes) / number(row.runs));
    cells.emplace_back(row.expected.evaluations);
    cells.emplace_back(row.expected.time_ms);
  }
  return table;
}

TextTable cycle_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", ""},
                   {"motion_time_s", ""},
                   {"runs", ""},
                   {"mean_gain", ""},
                   {"mean_move_time_s", ""},
                   {"gain_per_s_moving_s_wall", ""},
                   {"gain_per_s_waiting_s_wall", ""},
                   {"added_per_s_waiting_s_wall", ""}},
                  {}};
  for (const study::Cycle& row : evaluation.cycles) {
    table.rows.push_back({results.solvers[row.solver], row.motion_time_s, number(row.runs),
                          row.mean_gain, row.mean_move_time_s, row.gain_per_s_moving,
                          row.gain_per_s_waiting, row.added_per_s_waiting});
  }
  return table;
}

TextTable cycle_overview(const Results& results, const Evaluation& evaluation,
                         double study::Cycle::*figure) {
  TextTable table = solver_rows(results);
  for (const study::Cycle& row : evaluation.cycles) {
    if (row.solver == 0) {
      table.columns.push_back({"", motion_time_label(row.motion_time_s), two_digits});
    }
    table.rows[row.solver].emplace_back(row.*figure);
  }
  return table;
}

TextTable best_motion_time_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", ""},
                   {"map", ""},
                   {"best_motion_time_moving_s_wall", ""},
                   {"best_motion_time_waiting_s_wall", ""},
                   {"best_motion_time_adding_s_wall", ""}},
                  {}};
  for (const study::BestMotionTime& row : evaluation.best_motion_times) {
    table.rows.push_back(
        {results.solvers[row.solver], row.map, row.moving_s, row.waiting_s, row.adding_s});
  }
  return table;
}

TextTable best_motion_time_overview(const Results& results, const Evaluation& evaluation) {
  const auto label = [](double motion_time_s) {
    return std::isnan(motion_time_s) ? std::string("-") : motion_time_label(motion_time_s);
  };
  TextTable table = solver_rows(results);
  for (const study::BestMotionTime& row : evaluation.best_motion_times) {
    if (row.solver == 0) table.columns.push_back({"", row.map});
    table.rows[row.solver].emplace_back(label(row.moving_s) + ", " + label(row.waiting_s) + ", " +
                                        label(row.adding_s));
  }
  return table;
}

TextTable comparison_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", "solver"},
                   {"cases", "cases"},
                   {"zeros", "equal"},
                   {"rank_sum_above", ""},
                   {"rank_sum_below", ""},
                   {"p_method", ""},
                   {"p", "p", p_digits},
                   {"p_holm", "p (Holm)", p_digits},
                   {"median_difference", "median difference", difference_digits},
                   {"rank_biserial", "rank-biserial", two_digits}},
                  {}};
  for (const study::Comparison& row : evaluation.comparisons) {
    table.rows.push_back({results.solvers[row.solver], number(row.test.pairs + row.test.zeros),
                          number(row.test.zeros), row.test.rank_sum_above, row.test.rank_sum_below,
                          row.test.is_exact ? "exact" : "normal", row.test.p, row.holm_p,
                          row.median_difference, row.test.rank_biserial});
  }
  return table;
}

TextTable modes_table(const study::ModeTable& modes) {
  TextTable table{{{"chosen", ""}, {"judged", ""}, {"pairs", ""}, {"gain_ratio", ""}}, {}};
  for (std::size_t chosen = 0; chosen < kModes.size(); ++chosen) {
    for (std::size_t judged = 0; judged < kModes.size(); ++judged) {
      table.rows.push_back({kModes[chosen], kModes[judged], number(modes.pairs[chosen][judged]),
                            modes.ratio[chosen][judged]});
    }
  }
  return table;
}

TextTable modes_overview(const study::ModeTable& modes) {
  TextTable table{{{"", "chosen by"}}, {}};
  const auto is_studied = [&](std::size_t mode) { return modes.pairs[mode][mode] > 0; };
  for (std::size_t chosen = 0; chosen < kModes.size(); ++chosen) {
    if (!is_studied(chosen)) continue;
    table.columns.push_back({"", std::string("judged by ") + kModes[chosen], ratio_digits});
    std::vector<TableCell>& row = table.rows.emplace_back();
    row.emplace_back(kModes[chosen]);
    for (std::size_t judged = 0; judged < kModes.size(); ++judged) {
      if (is_studied(judged)) row.emplace_back(modes.ratio[chosen][judged]);
    }
  }
  return table;
}

TextTable performance_profile_table(const Results& results, const Evaluation& evaluation) {
  constexpr int kSteps = 120;
  constexpr double kDecades = 3.0;
  TextTable table{{{"solver", ""}, {"tau", ""}, {"share_by_evaluations", ""}, {"share_by_ms", ""}},
                  {}};
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    const study::SolverProfiles& own = evaluation.performance[solver];
    for (int i = 0; i <= kSteps; ++i) {
      const double tau = std::pow(10.0, kDecades * i / kSteps);
      table.rows.push_back({results.solvers[solver], tau, own.evaluations.share_within(tau),
                            own.time_ms.share_within(tau)});
    }
    table.rows.push_back({results.solvers[solver], std::numeric_limits<double>::infinity(),
                          own.evaluations.share_answered(), own.time_ms.share_answered()});
  }
  return table;
}

TextTable data_profile_table(const Results& results, const Evaluation& evaluation) {
  TextTable table{{{"solver", ""},
                   {"cost_evaluations", ""},
                   {"share_by_evaluations", ""},
                   {"cost_ms", ""},
                   {"share_by_ms", ""}},
                  {}};
  const auto& profiles = evaluation.data;
  const auto evaluations = cost_grid(profiles, &study::SolverProfiles::evaluations);
  const auto times_ms = cost_grid(profiles, &study::SolverProfiles::time_ms);
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      table.rows.push_back({results.solvers[solver], evaluations[i],
                            profiles[solver].evaluations.share_within(evaluations[i]), times_ms[i],
                            profiles[solver].time_ms.share_within(times_ms[i])});
    }
  }
  return table;
}

}  // namespace nbvopt
