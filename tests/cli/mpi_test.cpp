// Studies and reproductions under mpirun, as its users run them.
#include <gmock/gmock.h>

#include <csignal>
#include <map>
#include <random>

#include "cli/command_line.hpp"
#include "core/text_file.hpp"
#include "support/background_process.hpp"
#include "support/paths.hpp"
#include "support/wait_until.hpp"

namespace nbvopt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Mpi : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(NBVOPT_MPIRUN).empty()) GTEST_SKIP() << "built without MPI";
    write_map(room(), folder / "room.ot", MapFormat::uncertainty_ot);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    // Under the address sanitizer: what MPI's plugins leak is not ours.
    ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
  }

  std::string spec(const std::string& seeds) const {
    return folder.write("spec.yaml",
                        "maps: [room.ot]\n"
                        "starts: {sampled: {count: 4}}\n"
                        "motion_times_s: [0.5]\n"
                        "solvers: [{solver: auto}, {solver: random}]\n"
                        "budgets: {max_evaluations: [20, 100]}\n"
                        "seeds: " +
                            seeds + '\n');
  }

  std::vector<std::string> study_into(const std::string& out, const std::string& file) const {
    return {"study", "run", file, "--out", folder / out};
  }

  /// mpirun's arguments before those of a program on `ranks` ranks.
  static std::vector<std::string> mpirun(int ranks, const std::vector<std::string>& program) {
    std::vector<std::string> arguments{"--oversubscribe", "-n", std::to_string(ranks)};
    arguments.insert(arguments.end(), program.begin(), program.end());
    return arguments;
  }
  static std::vector<std::string> with_nbvopt(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), cli_program());
    return arguments;
  }

  std::map<std::string, nlohmann::json> records(const std::string& out) const {
    std::map<std::string, nlohmann::json> result;
    for (nlohmann::json& record : lines_of(folder / out + "/records.jsonl")) {
      record.erase("times");
      EXPECT_TRUE(result.emplace(record.at("unit"), record).second) << "recorded twice";
    }
    return result;
  }

  std::uintmax_t record_bytes(const std::string& out) const {
    std::error_code not_there_yet;
    const std::uintmax_t size =
        std::filesystem::file_size(folder / out + "/records.jsonl", not_there_yet);
    return not_there_yet ? 0 : size;
  }

  const TemporaryFolder folder;
};

TEST_F(Mpi, RecordsAreThoseOfLocalProcesses) {
  const std::string file = spec("[1]");
  ASSERT_EQ(nbvopt_run(study_into("local", file)).exit_code, 0);
  const ProcessResult result =
      run_process(NBVOPT_MPIRUN, mpirun(3, with_nbvopt(study_into("ranks", file))));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 workers busy"));
  EXPECT_EQ(records("ranks"), records("local"));
}

TEST_F(Mpi, SurvivesKills) {
  const std::string file = spec("[1, 2, 3, 4, 5, 6]");
  ASSERT_EQ(nbvopt_run(study_into("whole", file)).exit_code, 0);
  std::mt19937_64 random(1);
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    const std::uintmax_t size = record_bytes("killed");
    BackgroundProcess process(NBVOPT_MPIRUN, mpirun(3, with_nbvopt(study_into("killed", file))),
                              folder / "killed.log");
    const std::uintmax_t more = 500 + random() % 10'000;
    ASSERT_TRUE(wait_until([&] { return record_bytes("killed") > size + more; }));
    process.send(signal);
    ASSERT_NE(process.wait(), 0) << "it ended before it was killed";
  }
  // The ranks of an mpirun that was killed end soon after.
  ASSERT_TRUE(wait_until([&] {
    return run_process(NBVOPT_MPIRUN, mpirun(3, with_nbvopt(study_into("killed", file))))
               .exit_code == 0;
  }));
  EXPECT_EQ(records("killed"), records("whole"));
}

TEST_F(Mpi, ARefusalEndsAllRanks) {
  const ProcessResult result =
      run_process(NBVOPT_MPIRUN, mpirun(3, with_nbvopt(study_into("out", "/nowhere.yaml"))));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("nbvopt: /nowhere.yaml: cannot be opened"));
}

TEST_F(Mpi, NamesAFileThatARankDoesNotSee) {
  const std::vector<std::string> unshare{"--mount", "--map-root-user", "/bin/sh", "-c"};
  const auto in_own_view = [&](const std::string& script) {
    std::vector<std::string> arguments = unshare;
    arguments.push_back(script);
    return arguments;
  };
  if (run_process("/usr/bin/unshare", in_own_view("mount -t tmpfs none /mnt")).exit_code != 0) {
    GTEST_SKIP() << "no file systems of its own can be given to a process here";
  }
  const std::string file = spec("[1]");
  const std::string study = cli_program() + " study run " + file + " --out " + (folder / "out");
  std::vector<std::string> arguments = mpirun(1, with_nbvopt(study_into("out", file)));
  arguments.insert(arguments.end(), {":", "-n", "1", "/usr/bin/unshare"});
  const auto hidden = in_own_view("mount -t tmpfs none " + (folder / "") + "; exec " + study);
  arguments.insert(arguments.end(), hidden.begin(), hidden.end());
  const ProcessResult result = run_process(NBVOPT_MPIRUN, arguments);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("rank 1: " + (folder / "room.ot")),
                                HasSubstr("put it where all machines see it")));
}

}  // namespace
}  // namespace nbvopt::test
