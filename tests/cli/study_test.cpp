// nbvopt study as its users run it.
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "cli/command_line.hpp"
#include "core/text_file.hpp"
#include "support/background_process.hpp"
#include "support/paths.hpp"
#include "support/wait_until.hpp"

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

  std::uintmax_t record_bytes(const std::string& out) const {
    std::error_code not_there_yet;
    const std::uintmax_t size =
        std::filesystem::file_size(folder / out + "/records.jsonl", not_there_yet);
    return not_there_yet ? 0 : size;
  }

  /// The records that are known to be there, whatever stands behind them.
  std::size_t whole_lines(const std::string& out) const {
    const std::string text = read_text_file(folder / out + "/records.jsonl");
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
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
  constexpr std::size_t kUnits = 1152;
  const std::string file = spec("seeds: [1, 2, 3, 4]\n");
  ASSERT_EQ(nbvopt_run(run_arguments("whole", file)).exit_code, 0);
  ASSERT_EQ(records("whole").size(), kUnits);
  std::mt19937_64 random(1);
  std::size_t done = 0;
  for (int kill = 0; kill < 20; ++kill) {
    const std::uintmax_t size = record_bytes("killed");
    BackgroundProcess process(cli_program(), run_arguments("killed", file), folder / "killed.log");
    if (kill % 5 == 4) {  // while it starts, or soon after
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 30));
    } else {
      // Up to some ten records later.
      const std::uintmax_t more = 500 + random() % 10'000;
      ASSERT_TRUE(wait_until([&] { return record_bytes("killed") > size + more; }));
    }
    process.send(SIGKILL);
    ASSERT_EQ(process.wait(), -1) << "it ended before it was killed";
    const std::size_t done_before = done;
    done = whole_lines("killed");
    EXPECT_LT(done, kUnits);
    EXPECT_GE(done, done_before + (kill % 5 == 4 ? 0 : 1));
  }
  const ProcessResult rest = nbvopt_run(run_arguments("killed", file));
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("\n" + std::to_string(done) + " done (0 failed), "));
  EXPECT_EQ(records("killed"), records("whole"));
}

TEST_F(StudyCommand, AStopKeepsWhatWasDone) {
  const std::string file = spec("seeds: [1, 2, 3, 4, 5, 6]\n");
  BackgroundProcess process(cli_program(), run_arguments("out", file), folder / "stopped.log");
  ASSERT_TRUE(wait_until([&] { return record_bytes("out") > 0; }));
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), -1) << "it ends by the signal";
  const std::size_t done = records("out").size();
  EXPECT_GT(done, 0U);
  EXPECT_LT(done, 1728U);
  const ProcessResult rest = nbvopt_run(run_arguments("out", file));
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("\n" + std::to_string(done) + " done (0 failed), "));
  EXPECT_EQ(records("out").size(), 1728U);
}

TEST_F(StudyCommand, OtherEnginesTakeUnitsAndGiveAnswersBack) {
  const std::string file = spec();
  ASSERT_EQ(nbvopt_run(run_arguments("whole", file)).exit_code, 0);
  const std::vector<std::string> rest{file, "--out", folder / "other"};
  const auto ask = [&](const std::string& command, const std::string& input = {}) {
    std::vector<std::string> arguments{"study", command};
    arguments.insert(arguments.end(), rest.begin(), rest.end());
    return nbvopt_run(arguments, input);
  };
  const std::string units = ask("units").out;
  const std::string said = nbvopt_run({"study", "worker"}, units).out;
  const std::string answers = said.substr(said.find('\n') + 1);  // after its hello
  const std::string kept = ask("record", answers).out;
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(kept, '\n')), records("whole").size());
  EXPECT_THAT(kept, HasSubstr(records("whole").begin()->first + '\n'));
  EXPECT_EQ(records("other"), records("whole"));
  EXPECT_EQ(ask("units").out, "");
  EXPECT_EQ(ask("record", answers).out, kept) << "they have been";
  expect_refusal(ask("record", "garbage\n"), 3, "answers: line 1: is no answer to a unit");
  EXPECT_EQ(records("other"), records("whole"));
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
