#include "study/report/report.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "report/text_table.hpp"
#include "study/made_results.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

using study::failed_run;
using study::made_results;
using study::made_run;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(TextTable, IsRoundedForPeople) {
  const TextTable table{{{"name", "name"}, {"", "count"}, {"only_machines", ""}},
                        {{"a|b", 1234567.4, 1.0}, {"none", kNaN, 2.0}, {"c", HUGE_VAL, 3.0}}};
  EXPECT_EQ(to_markdown(table),
            "| name | count |\n| --- | ---: |\n"
            "| a\\|b | 1,234,567 |\n| none | - |\n| c | never |\n");
}

TEST(TextTable, IsWholeForMachines) {
  const TextTable table{{{"name", "name"}, {"", "for people"}, {"value_ms", ""}},
                        {{"0.8 rad, \"pan\"", 1.0, 0.1}, {"none", 1.0, kNaN}, {"", 1.0, HUGE_VAL}}};
  EXPECT_EQ(to_csv(table), "name,value_ms\n\"0.8 rad, \"\"pan\"\"\",0.1\nnone,\n,inf\n");
}

/// Two maps, of which one case has no reference; auto is good, random never gets to 95 % and fails
/// once, and one answer exceeds its reference.
class StudyReport : public testing::Test {
 protected:
  StudyReport()
      : results(made_results({"auto", "paper, 0.8 rad", "random"},
                             {1000.0, 1000.0, 1000.0, 0.0, kNaN})) {
    results.budgets = {{10, 0.0}, {100, 0.0}, {0, 50.0}};
    results.cases[2].map = "hall.ot";
    results.cases[1].motion_time_s = 0.5;
    for (std::size_t i = 0; i < 5; ++i) {
      const double known = i == 3 ? 0.0 : 1000.0;
      for (std::size_t budget = 0; budget < 3; ++budget) {
        const auto add = [&](std::size_t solver, double share, std::int64_t evaluations) {
          results.runs.push_back(made_run({.case_index = i,
                                           .solver = solver,
                                           .gain = share * known,
                                           .evaluations = evaluations,
                                           .time_ms = static_cast<double>(evaluations) / 4.0,
                                           .budget = budget}));
        };
        add(0, i == 0 ? 1.001 : 0.995, 40);
        add(1, 0.96, 20);
        add(2, 0.5, 100);
      }
    }
    results.runs.back() = failed_run({.case_index = 4, .solver = 2, .budget = 2});
    results.missing_runs = 7;
  }

  std::string written(const std::string& name) const {
    return read_text_file(folder.path() / "report" / name);
  }

  void write() const { write_report(results, folder.path() / "report"); }

  const TemporaryFolder folder;
  study::Results results;
};

TEST_F(StudyReport, SaysHowManyReferencesAreCertified) {
  results.cases[0].best_known = results.cases[1].best_known = results.cases[2].best_known = 1000.0;
  results.cases[0].upper_bound = 1005.0;
  results.cases[1].upper_bound = 1020.0;
  results.cases[2].upper_bound = 1250.0;
  write();
  EXPECT_THAT(
      written("report.md"),
      HasSubstr("Of 3 references 1 are certified: no view in reach gains 1 % more. The best "
                "known gain is within 1.96 % of what is proved to be the most in the median "
                "case, and within 20.00 % in the worst."));
}

TEST_F(StudyReport, SaysWhatItMeasuresAgainst) {
  write();
  EXPECT_THAT(written("report.md"), HasSubstr("over the best exact gain known for its case"));
  results.against = study::Against::upper_bound;
  write();
  EXPECT_THAT(written("report.md"), HasSubstr("over the bound that no view of its case exceeds"));
}

TEST_F(StudyReport, SaysWhatWasStudied) {
  write();
  const std::string text = written("report.md");
  EXPECT_THAT(text, StartsWith("# Study made\n\n5 cases on 2 maps (hall.ot, room.ot), 3 solvers, 3 "
                               "budgets (10 evaluations, 100 evaluations, 50 ms): 45 runs, of "
                               "which 1 failed; 7 more are missing.\n"));
  EXPECT_THAT(text, HasSubstr("loosest budget, 100 evaluations."));
  EXPECT_THAT(text, HasSubstr("- 7 runs are missing"));
  EXPECT_THAT(text, HasSubstr("- 1 run failed"));
  EXPECT_THAT(text, HasSubstr("- 1 case has no reference"));
  EXPECT_THAT(text, HasSubstr("- 3 answers exceed their references, at most by 0.100 %"));
}

TEST_F(StudyReport, HoldsTheFigures) {
  write();
  const std::string text = written("report.md");
  // Of the four cases with a reference one has nothing to gain, which all reach.
  EXPECT_THAT(text,
              HasSubstr("| auto | 5 | 0 | 0.9978 | 0.9950 to 0.9998 | 0.9975 | 0.9950 | 40 | 0 | "
                        "10.0 | 10.0 |"));
  EXPECT_THAT(text, HasSubstr("| paper, 0.8 rad | 1.0000 | 20 | 5.00 | 0.2500 | 80 | 20.0 |"));
  EXPECT_THAT(text, HasSubstr("| random | 0.6250 | 0.6250 | 0.6250 |"));
  EXPECT_THAT(written("ert.csv"), HasSubstr("\nrandom,0.99,4,1,400,100\n"));
  EXPECT_THAT(written("summary.csv"), HasSubstr("\nrandom,0,50,5,1,0.625,0.5,0.83333"));
  EXPECT_THAT(written("summary.csv"), HasSubstr(",0.5,0.5,100,0,25,25\n"));
  EXPECT_THAT(written("wilcoxon.csv"), HasSubstr("\nrandom,4,1,0,6,exact,0.25,"));
  EXPECT_THAT(written("best_motion_time.csv"), HasSubstr("\nauto,room.ot,0.5,0.5,0.5\n"));
}

TEST_F(StudyReport, JudgesByAllPixelsWhereThatIsKnown) {
  write();
  EXPECT_THAT(written("report.md"), Not(HasSubstr("By all pixels")));
  for (auto& one : results.cases) one.dense_gain = 200.0;
  for (auto& run : results.runs) run.dense_gain = run.solver == 0 ? 150.0 : 250.0;
  write();
  EXPECT_THAT(written("report.md"), HasSubstr("views have 0.8000 of it"));
  EXPECT_THAT(written("dense.csv"), HasSubstr("\nauto,5,0.6,0.6,0.6,0.6\n"));
  for (auto& one : results.cases) one.dense_gain = kNaN;
  write();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report" / "dense.csv"))
      << "it is of the report before";
}

TEST_F(StudyReport, SaysNeverWhereNothingIsReached) {
  results.cases[3].reference_gain = kNaN;
  write();
  EXPECT_THAT(written("report.md"), HasSubstr("| random | 0.0000 | never | never | 0.0000 |"));
  EXPECT_THAT(written("ert.csv"), HasSubstr("\nrandom,0.95,3,0,inf,inf\n"));
}

/// Commas outside of quotes.
std::size_t columns(const std::string& line) {
  bool is_quoted = false;
  std::size_t count = 1;
  for (const char letter : line) {
    if (letter == '"') is_quoted = !is_quoted;
    if (letter == ',' && !is_quoted) ++count;
  }
  return count;
}

TEST_F(StudyReport, CsvFilesHaveACellAColumn) {
  results.cases[0].mode = UncertaintyMode::angle;  // so that there are several modes
  write();
  for (const char* name :
       {"summary.csv", "ert.csv", "budgets.csv", "cycle.csv", "best_motion_time.csv",
        "wilcoxon.csv", "performance_profile.csv", "data_profile.csv", "modes.csv"}) {
    std::istringstream lines(written(name));
    std::string header;
    std::getline(lines, header);
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line); ++rows) {
      EXPECT_EQ(columns(line), columns(header)) << name << ": " << line;
    }
    EXPECT_GT(rows, 1U) << name;
  }
}

TEST_F(StudyReport, OnlyColumnsOfTimesDifferWhenTimesDo) {
  results.budgets.pop_back();  // what a time limit allows differs in all
  std::erase_if(results.runs, [](const auto& run) { return run.budget == 2; });
  const auto without_times = [this](const std::string& name) {
    std::istringstream lines(written(name));
    std::string text;
    std::vector<bool> is_time;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      std::size_t i = 0;
      const bool is_header = is_time.empty();
      for (std::string cell; std::getline(cells, cell, ','); ++i) {
        if (is_header) is_time.push_back(cell.ends_with("_ms") || cell.ends_with("_s_wall"));
        if (!is_time.at(i)) text += cell + ' ';
      }
      text += '\n';
    }
    return text;
  };
  results.solvers[1] = "paper";  // no comma, so that splitting lines is simple
  const std::vector<std::string> names{"summary.csv",
                                       "ert.csv",
                                       "budgets.csv",
                                       "cycle.csv",
                                       "best_motion_time.csv",
                                       "wilcoxon.csv",
                                       "performance_profile.csv",
                                       "data_profile.csv"};
  write();
  std::vector<std::string> before;
  for (const std::string& name : names) before.push_back(without_times(name));
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    results.runs[i].search_time_ms *= 1.0 + static_cast<double>(i);
  }
  write();
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(without_times(names[i]), before[i]);
}

TEST_F(StudyReport, TellsOfModesOnlyWhereThereAreSeveral) {
  results.cases[0].mode = UncertaintyMode::angle;
  write();
  EXPECT_THAT(written("report.md"), HasSubstr("## Uncertainty modes"));
  EXPECT_THAT(written("report.md"), HasSubstr("| chosen by | judged by angle | judged by both |"));
  results.cases[0].mode = UncertaintyMode::both;
  write();
  EXPECT_THAT(written("report.md"), Not(HasSubstr("## Uncertainty modes")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report" / "modes.csv"));
}

TEST_F(StudyReport, DrawsPictures) {
  write();
  for (const char* name :
       {"performance_profile.png", "data_profile.png", "budget.png", "cycle.png"}) {
    const std::string picture = written(name);
    EXPECT_THAT(picture, StartsWith("\x89PNG\r\n\x1a\n")) << name;
    EXPECT_THAT(picture, HasSubstr("IEND")) << name;
    EXPECT_THAT(written("report.md"), HasSubstr(name));
  }
}

TEST_F(StudyReport, IsWrittenOfAStudyThatHasNotBegun) {
  results.runs.clear();
  write();
  EXPECT_THAT(written("report.md"), HasSubstr("| auto | 0 | 0 | - | - | - |"));
  EXPECT_THAT(written("budget.png"), StartsWith("\x89PNG"));
}

TEST_F(StudyReport, WritesNothingWhereTheFolderCannotBe) {
  const std::string file = folder.write("file", "not a folder");
  const std::string message =
      message_of<InputError>([&] { write_report(results, file + "/report"); });
  EXPECT_THAT(message, HasSubstr(file + "/report: cannot be created: "));
  EXPECT_EQ(read_text_file(file), "not a folder");
}

TEST_F(StudyReport, WithoutSolversOrBudgetsIsRefused) {
  study::Results nothing = results;
  nothing.runs.clear();
  nothing.solvers.clear();
  EXPECT_THROW(write_report(nothing, folder.path() / "report"), UsageError);
  nothing = results;
  nothing.runs.clear();
  nothing.budgets.clear();
  EXPECT_THROW(write_report(nothing, folder.path() / "report"), UsageError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report"));
}

}  // namespace
}  // namespace nbvopt::test
