#include "study/study_run.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <map>

#include "core/text_file.hpp"
#include "experiment/process_pool.hpp"
#include "experiment/record_file.hpp"
#include "nbvopt/core/error.hpp"
#include "study/record.hpp"
#include "study/study_fixture.hpp"
#include "support/error_message.hpp"

namespace nbvopt::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Records by their unit, without what depends on time.
using Records = std::map<std::string, Json>;

class StudyRun : public testing::Test {
 protected:
  experiment::RunResult run(const Study& study, const std::string& name, std::size_t workers = 2,
                            WorkKind kind = WorkKind::query, bool retry_failed = false) {
    experiment::ProcessPool pool({NBVOPT_ODD_WORKER}, workers);
    return run_study(study, folder(name), kind, {.retry_failed = retry_failed}, pool,
                     [this](const Json& record) { on_end(record); });
  }

  /// The same with workers that a command starts, into the folder "out".
  experiment::RunResult run_with(const std::vector<std::string>& command, const Study& study,
                                 std::size_t workers = 1) {
    experiment::ProcessPool pool(command, workers);
    return run_study(study, folder("out"), WorkKind::query, {}, pool, on_end);
  }

  StudyFolder folder(const std::string& name) const { return {files.folder / name}; }

  static Records records(const std::filesystem::path& file) {
    Records result;
    experiment::for_each_record(file, [&](const Json& record) {
      Json timeless = record;
      timeless.erase("times");
      result[record_id(record)] = timeless;
    });
    return result;
  }

  /// A spec with pan grids of these steps only, besides the paper's.
  Study grids(const std::string& steps, const std::string& unit_timeout_s = "60") const {
    return files.read(
        "maps: [cluttered.ot]\n"
        "starts: {sampled: {count: 2}}\n"
        "motion_times_s: [0.5]\n"
        "unit_timeout_s: " +
        unit_timeout_s + "\nsolvers: [{solver: grid, step_pan_rad: " + steps + "}]\n");
  }

  const test::StudyFiles files;
  std::function<void(const Json&)> on_end = [](const Json&) {};
};

TEST_F(StudyRun, RecordsEveryUnit) {
  const Study study = files.read(test::kSmallSpec);
  const experiment::RunResult result = run(study, "out");
  EXPECT_EQ(result.finished, 36U);
  EXPECT_EQ(result.failed, 0U);
  EXPECT_EQ(records(folder("out").records()).size(), 36U);
  const WorkCount count = count_work(study, folder("out"), WorkKind::query);
  EXPECT_EQ(count.total, 36U);
  EXPECT_EQ(count.done, 36U);
  EXPECT_EQ(run(study, "out").finished, 0U) << "what is done is not run again";
}

TEST_F(StudyRun, DoesNotDependOnTheNumberOfWorkers) {
  const Study study = files.read(test::kSmallSpec);
  run(study, "one", 1);
  run(study, "two", 2);
  run(study, "five", 5);
  const Records one = records(folder("one").records());
  EXPECT_EQ(one, records(folder("two").records()));
  EXPECT_EQ(one, records(folder("five").records()));
}

TEST_F(StudyRun, RecordsAnswersThatKeepTheirPromises) {
  const Study study = files.read(test::kSmallSpec);
  run(study, "out");
  run(study, "out", 2, WorkKind::reference);
  const Results results = read_results(study, folder("out"));
  EXPECT_EQ(results.missing_runs, 0U);
  ASSERT_EQ(results.runs.size(), 36U);
  for (const study::Run& run : results.runs) {
    const Budget& budget = results.budgets[run.budget];
    EXPECT_LE(run.evaluations + run.surrogate_evaluations, budget.max_evaluations);
    EXPECT_GE(run.gain, run.current_gain);
    EXPECT_EQ(run.gain, run.gain_by_mode[2]) << "the mode is both";
    const double pixels_per_ray = 100.0;  // of the paper's camera
    EXPECT_NEAR(run.dense_gain, pixels_per_ray * run.gain, 5.0 * run.gain);
    ASSERT_FALSE(run.progress.empty());
    EXPECT_EQ(run.progress.front().gain, run.current_gain);
    EXPECT_EQ(run.progress.front().evaluations, 1);
    for (std::size_t i = 1; i < run.progress.size(); ++i) {
      EXPECT_GT(run.progress[i].gain, run.progress[i - 1].gain);
      EXPECT_GT(run.progress[i].evaluations, run.progress[i - 1].evaluations);
      EXPECT_GE(run.progress[i].time_ms, run.progress[i - 1].time_ms);
    }
    const bool is_released_code = results.solvers[run.solver].starts_with("paper, released");
    if (!is_released_code) {
      EXPECT_EQ(run.progress.back().gain, run.gain);
    }
    const CaseResult& one = results.cases[run.case_index];
    EXPECT_LE(run.gain, one.upper_bound);
    EXPECT_LE(one.best_known, one.upper_bound);
    EXPECT_NEAR(one.dense_gain, 100.0 * one.best_known, 5.0 * one.best_known);
    const double reference = one.reference_gain;
    EXPECT_LE(run.gain, reference * (1.0 + 2e-3));
  }
}

TEST_F(StudyRun, GoesOnAfterATornLine) {
  const Study study = files.read(test::kSmallSpec);
  run(study, "whole");
  run(study, "torn");
  const std::string file = folder("torn").records().string();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const experiment::RunResult rest = run(study, "torn");
  EXPECT_GT(rest.finished, 10U);
  EXPECT_LT(rest.finished, 36U);
  EXPECT_EQ(records(folder("torn").records()), records(folder("whole").records()));
}

TEST_F(StudyRun, GrowsWithItsSpec) {
  run(files.read(test::kSmallSpec), "out");
  const Study more = files.read(std::string(test::kSmallSpec) + "seeds: [1, 2]\n");
  EXPECT_EQ(run(more, "out").finished, 36U);
  EXPECT_EQ(read_results(more, folder("out")).runs.size(), 72U);
  EXPECT_EQ(read_results(read_study(folder("out")), folder("out")).runs.size(), 72U);
}

TEST_F(StudyRun, ASolverThatThrowsCostsItsUnits) {
  const Study study = grids("[0.11, 0.3]");
  const experiment::RunResult result = run(study, "out");
  EXPECT_EQ(result.finished, 12U);
  EXPECT_EQ(result.failed, 2U);
  for (const auto& [id, record] : records(folder("out").records())) {
    const bool throws = record.at("search") == "grid, step_pan_rad 0.11";
    EXPECT_EQ(record.value("failure", ""), throws ? "the solver threw" : "");
  }
}

TEST_F(StudyRun, ASolverThatHangsIsStopped) {
  // Long enough for the others' units on a machine that is busy.
  const Study study = grids("[0.12, 0.3]", "10");
  const experiment::RunResult result = run(study, "out");
  EXPECT_EQ(result.finished, 12U);
  EXPECT_EQ(result.failed, 2U);
  const Results results = read_results(study, folder("out"));
  EXPECT_EQ(results.runs[0].failure, "stopped by the watchdog after 10 s");
}

TEST_F(StudyRun, ASolverThatEndsItsWorkerCostsItsUnits) {
  const Study study = grids("[0.13, 0.3]");
  const experiment::RunResult result = run(study, "out");
  EXPECT_EQ(result.finished, 12U);
  EXPECT_EQ(result.failed, 2U);
  EXPECT_EQ(read_results(study, folder("out")).runs[0].failure, "its worker ended, twice: Aborted");
}

TEST_F(StudyRun, RunsWhatHasFailedAgainWhenAsked) {
  const Study study = grids("[0.11]");
  run(study, "out");
  EXPECT_EQ(run(study, "out").finished, 0U);
  EXPECT_EQ(run(study, "out", 2, WorkKind::query, true).finished, 2U);
}

TEST_F(StudyRun, RefusesAWorkerThatIsNone) {
  const Study study = files.read(test::kSmallSpec);
  const auto message_with = [&](const std::vector<std::string>& command) {
    return test::message_of<InputError>([&] { run_with(command, study, 2); });
  };
  EXPECT_THAT(message_with({"/nowhere/worker"}),
              AllOf(HasSubstr("/nowhere/worker"), HasSubstr("cannot be started")));
  EXPECT_THAT(message_with({"/bin/false"}),
              AllOf(HasSubstr("/bin/false"), HasSubstr("ended before its first line")));
  EXPECT_THAT(message_with({"/bin/echo", "hello"}), HasSubstr("is no worker"));
  EXPECT_THAT(test::message_of<InputError>([&] { run(grids("[0.14]"), "noise"); }),
              HasSubstr("wrote what is no answer: noise"));
}

/// A worker written in a shell: it says hello, then runs the script once for each line.
std::vector<std::string> shell_worker(const std::string& script) {
  return {"/bin/sh", "-c",
          R"(echo '{"protocol":1}'; while read -r line; do id=$(echo "$line" | cut -d'"' -f4); )" +
              script + "; done"};
}

TEST_F(StudyRun, TakesAnswersOfTheUnitAtWorkOnly) {
  const Study study = grids("[0.3]");
  const auto message_with = [&](const std::string& script) {
    return test::message_of<InputError>([&] { run_with(shell_worker(script), study); });
  };
  for (const char* script :
       {R"(echo '{"unit":"another","answer":{},"busy_ms":1}')",
        R"(echo "{\"unit\":\"$id\",\"busy_ms\":1}")",
        R"(echo "{\"unit\":\"$id\",\"answer\":3,\"busy_ms\":1}")",
        R"(echo "{\"unit\":\"$id\",\"failure\":\"\",\"busy_ms\":1}")", "echo 3"}) {
    EXPECT_THAT(message_with(script), HasSubstr("wrote what is no answer")) << script;
  }
  EXPECT_EQ(message_with(R"(echo "{\"unit\":\"$id\",\"failure\":\"tired\",\"busy_ms\":1}")"), "");
  EXPECT_EQ(read_results(study, folder("out")).runs[0].failure, "tired");
}

TEST_F(StudyRun, AUnitWhoseWorkerWasKilledOnceIsRunAgain) {
  const Study study = grids("[0.3]");
  const std::string mark = files.folder / "mark";
  const std::string script = "test -e '" + mark + "' || { : > '" + mark + "'; kill -9 $$; }; " +
                             R"(echo "{\"unit\":\"$id\",\"failure\":\"tired\",\"busy_ms\":1}")";
  const experiment::RunResult result = run_with(shell_worker(script), study);
  EXPECT_EQ(result.finished, unit_count(study));
  for (const study::Run& run : read_results(study, folder("out")).runs) {
    EXPECT_EQ(run.failure, "tired");
  }
}

TEST_F(StudyRun, AWorkerThatTurnsSilentIsReplaced) {
  const Study study = grids("[0.3]");
  const experiment::RunResult result = run_with(shell_worker("exec 1>&-; sleep 100"), study, 2);
  EXPECT_EQ(result.failed, unit_count(study));
  EXPECT_THAT(read_results(study, folder("out")).runs[0].failure,
              HasSubstr("its worker ended, twice: "));
}

TEST_F(StudyRun, RefusesRecordsOfAnotherSchema) {
  const Study study = files.read(test::kSmallSpec);
  std::filesystem::create_directories(folder("out").root);
  files.folder.write("out/records.jsonl", "{\"schema\":2,\"unit\":\"x\"}\n");
  EXPECT_THAT(test::message_of<InputError>([&] { run(study, "out"); }),
              AllOf(HasSubstr("records.jsonl: line 1"), HasSubstr("schema 2")));
}

TEST_F(StudyRun, RefusesAFolderInUse) {
  const Study study = files.read(test::kSmallSpec);
  std::string message;
  on_end = [&](const Json&) {
    if (message.empty()) {
      message = test::message_of<InputError>([&] { run(study, "out"); });
    }
  };
  run(study, "out", 1);
  EXPECT_THAT(message, HasSubstr("another run writes this study"));
}

TEST_F(StudyRun, FailsUnitsWhoseMapHasChanged) {
  const Study study = files.read(test::kSmallSpec);
  files.write_map_file("cluttered.ot", 99);
  EXPECT_EQ(run(study, "out").failed, 36U);
  EXPECT_THAT(read_results(study, folder("out")).runs[0].failure,
              HasSubstr("has changed since the study began"));
}

TEST_F(StudyRun, WhatAnObserverThrowsEndsIt) {
  const Study study = files.read(test::kSmallSpec);
  on_end = [](const Json&) { throw InputError("enough"); };
  EXPECT_EQ(test::message_of<InputError>([&] { run(study, "out"); }), "enough");
  on_end = [](const Json&) {};
  run(study, "out");
  EXPECT_EQ(records(folder("out").records()).size(), 36U);
}

TEST_F(StudyRun, AStopLosesNothing) {
  const Study study = files.read(test::kSmallSpec);
  run(study, "whole");
  std::size_t ended = 0;
  on_end = [&](const Json&) {
    if (++ended == 5) std::raise(SIGINT);  // held back by the coordinator
  };
  const experiment::RunResult stopped = run(study, "stopped");
  EXPECT_EQ(stopped.stopped_by, SIGINT);
  EXPECT_LT(stopped.finished, 36U);
  EXPECT_EQ(records(folder("stopped").records()).size(), stopped.finished);
  on_end = [](const Json&) {};
  run(study, "stopped");
  EXPECT_EQ(records(folder("stopped").records()), records(folder("whole").records()));
}

}  // namespace
}  // namespace nbvopt::study
