// nbvopt study as its users run it.
#include <gmock/gmock.h>

#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "cli/command_line.hpp"
#include "support/background_process.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

using testing::HasSubstr;

class StudyCommand : public testing::Test {
 protected:
  StudyCommand() { write_map(room(), folder / "room.ot", MapFormat::uncertainty_ot); }

  std::string spec(const std::string& more = {}) const {
    return folder.write("spec.yaml",
                        "maps: [room.ot]\n"
                        "starts: {sampled: {count: 12}}\n"
                        "motion_times_s: [0.5, 1]\n"
                        "solvers: [{solver: auto}, {solver: random}]\n"
                        "budgets: {max_evaluations: [20, 100]}\n" +
                            more);
  }

  std::vector<std::string> run_arguments(const std::string& out, const std::string& file) const {
    return {"study", "run", file, "--out", folder / out};
  }

  /// The records by their unit, times left out. Every line must be whole.
  std::map<std::string, nlohmann::json> records(const std::string& out) const {
    std::map<std::string, nlohmann::json> result;
    for (nlohmann::json& record : lines_of(folder / out + "/records.jsonl")) {
      record.erase("times");
      const std::string unit = record.at("unit");
      EXPECT_FALSE(result.contains(unit)) << "recorded twice";
      result[unit] = record;
    }
    return result;
  }

  const TemporaryFolder folder;
};

TEST_F(StudyCommand, CountsWhatIsToBeDone) {
  const ProcessResult result =
      nbvopt_run({"study", "run", spec(), "--out", folder / "out", "--dry-run"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "1 map, 12 starts, 2 motion times, 1 uncertainty mode: 24 cases\n"
            "6 searches, 2 budgets, 1 seed: 288 units\n"
            "0 done (0 failed), 288 to run\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_F(StudyCommand, SaysHowWellWorkersWereUsed) {
  const ProcessResult result = nbvopt_run(run_arguments("out", spec()));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("288 units in "));
  EXPECT_THAT(result.out, HasSubstr("overhead "));
  EXPECT_EQ(records("out").size(), 288U);
  EXPECT_THAT(nbvopt_run(run_arguments("out", spec())).out, HasSubstr("nothing to do"));
}

TEST_F(StudyCommand, RefusesABadSpecBeforeAnythingRuns) {
  const std::string bad = spec("budget: 3\n");
  expect_refusal(nbvopt_run(run_arguments("out", bad)), 3,
                 "spec.yaml: line 6: unknown key 'budget', did you mean 'budgets'?");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  expect_refusal(nbvopt_run(run_arguments("out", folder / "none.yaml")), 3, "none.yaml");
  expect_refusal(nbvopt_run({"study"}), 2, "subcommand");
  folder.write("occupied", "");
  const ProcessResult blocked = nbvopt_run(run_arguments("occupied/out", spec()));
  EXPECT_EQ(blocked.exit_code, 3);
  EXPECT_THAT(blocked.err, HasSubstr("occupied/out: cannot be created"));
}

TEST_F(StudyCommand, SurvivesTwentyKills) {
  const std::string file = spec("seeds: [1, 2, 3, 4]\n");
  ASSERT_EQ(nbvopt_run(run_arguments("whole", file)).exit_code, 0);
  std::mt19937_64 random(1);
  for (int kill = 0; kill < 20; ++kill) {
    BackgroundProcess process(cli_program(), run_arguments("killed", file), folder / "killed.log");
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
    process.send(SIGKILL);
    process.wait();
  }
  ASSERT_EQ(nbvopt_run(run_arguments("killed", file)).exit_code, 0);
  EXPECT_EQ(records("killed"), records("whole"));
}

TEST_F(StudyCommand, AStopKeepsWhatWasDone) {
  const std::string file = spec("seeds: [1, 2, 3, 4, 5, 6]\n");
  BackgroundProcess process(cli_program(), run_arguments("out", file), folder / "stopped.log");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), -1) << "it ends by the signal";
  const std::size_t done = records("out").size();
  const ProcessResult rest = nbvopt_run(run_arguments("out", file));
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("\n" + std::to_string(done) + " done (0 failed), "));
  EXPECT_EQ(records("out").size(), 1728U);
}

TEST_F(StudyCommand, WorkersAnswerLineByLine) {
  const ProcessResult result = nbvopt_run({"study", "worker"}, "");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out).at("protocol"), 1);
  const ProcessResult confused = nbvopt_run({"study", "worker"}, "{\"unit\": 3}\n");
  EXPECT_EQ(confused.exit_code, 3);
  EXPECT_THAT(confused.err, HasSubstr("unit: "));
}

}  // namespace
}  // namespace nbvopt::test
