// The figures of a study as tables.
#pragma once

#include <string>

#include "report/text_table.hpp"
#include "study/evaluate/evaluation.hpp"
#include "study/results.hpp"

namespace nbvopt {

/// "1,000 evaluations", "50 ms", both joined by "and", or "no limit".
std::string budget_label(const study::Budget& budget);

/// "0.5 s", or "no limit".
std::string motion_time_label(double motion_time_s);

// For machines, in columns whose keys end in _ms or _s_wall where they depend on times; all but
// the first have a row for each combination, such as solver and target.

TextTable summary_table(const study::Results& results, const study::Evaluation& evaluation);
/// A row a solver, a column a budget; for people as well.
TextTable budget_table(const study::Results& results, const study::Evaluation& evaluation);
TextTable running_time_table(const study::Results& results, const study::Evaluation& evaluation);
TextTable cycle_table(const study::Results& results, const study::Evaluation& evaluation);
TextTable best_motion_time_table(const study::Results& results,
                                 const study::Evaluation& evaluation);
/// For people as well.
TextTable dense_table(const study::Results& results, const study::Evaluation& evaluation);
/// For people as well.
TextTable comparison_table(const study::Results& results, const study::Evaluation& evaluation);
TextTable modes_table(const study::ModeTable& modes);
TextTable performance_profile_table(const study::Results& results,
                                    const study::Evaluation& evaluation);
TextTable data_profile_table(const study::Results& results, const study::Evaluation& evaluation);

// For people: a row a solver.

/// Within the loosest budget.
TextTable main_table(const study::Results& results, const study::Evaluation& evaluation);
/// Columns for each target.
TextTable running_time_overview(const study::Results& results, const study::Evaluation& evaluation);
/// A column a motion time.
TextTable cycle_overview(const study::Results& results, const study::Evaluation& evaluation,
                         double study::Cycle::*figure);
/// A column a map; the motion times that are best by moving and by waiting.
TextTable best_motion_time_overview(const study::Results& results,
                                    const study::Evaluation& evaluation);
/// A row a mode that chose, a column a mode that judges, of those that the study has.
TextTable modes_overview(const study::ModeTable& modes);

}  // namespace nbvopt
