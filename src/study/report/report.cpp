#include "study/report/report.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/folder.hpp"
#include "nbvopt/core/error.hpp"
#include "study/report/plots.hpp"
#include "study/report/tables.hpp"
#include "study/report/text.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

// Files that not every report has.
constexpr const char* kModesFile = "modes.csv";
constexpr const char* kDenseFile = "dense.csv";

/// Name and content.
using File = std::pair<std::string, std::string>;

std::vector<File> make_files(const study::Results& results, const study::Evaluation& evaluation) {
  std::vector<File> files{
      {"report.md", study_text(results, evaluation)},
      {"summary.csv", to_csv(summary_table(results, evaluation))},
      {"ert.csv", to_csv(running_time_table(results, evaluation))},
      {"budgets.csv", to_csv(budget_table(results, evaluation))},
      {"cycle.csv", to_csv(cycle_table(results, evaluation))},
      {"best_motion_time.csv", to_csv(best_motion_time_table(results, evaluation))},
      {"wilcoxon.csv", to_csv(comparison_table(results, evaluation))},
      {"performance_profile.csv", to_csv(performance_profile_table(results, evaluation))},
      {"data_profile.csv", to_csv(data_profile_table(results, evaluation))},
      {"performance_profile.png", performance_profile_plot(results, evaluation)},
      {"data_profile.png", data_profile_plot(results, evaluation)},
      {"budget.png", budget_plot(results, evaluation)},
      {"cycle.png", cycle_plot(results, evaluation)}};
  if (evaluation.modes) files.emplace_back(kModesFile, to_csv(modes_table(*evaluation.modes)));
  if (!evaluation.dense.empty()) {
    files.emplace_back(kDenseFile, to_csv(dense_table(results, evaluation)));
  }
  return files;
}

}  // namespace

void write_report(const study::Results& results, const fs::path& folder) {
  if (results.solvers.empty()) throw UsageError("the study " + results.study + " has no solver");
  const study::Evaluation evaluation = study::evaluate(results);
  const std::vector<File> files = make_files(results, evaluation);
  create_folder(folder);
  for (const auto& [name, content] : files) write_file_atomically(folder / name, content);
  std::error_code ignored;
  for (const char* name : {kModesFile, kDenseFile}) {
    // Of an earlier report, when there was more to tell.
    if (std::ranges::count(files, name, &File::first) == 0) fs::remove(folder / name, ignored);
  }
}

}  // namespace nbvopt
