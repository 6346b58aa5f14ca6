#include "experiment/job_pool.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ProcessPool : public testing::Test {
 protected:
  Job shell(const std::string& script) {
    const std::string log = "job-" + std::to_string(++logs_) + ".log";
    return {"/bin/sh", {"-c", script}, folder / log, std::nullopt};
  }

  PoolResult run(const std::vector<Job>& jobs, std::size_t at_a_time) {
    return run_jobs(jobs, at_a_time,
                    [this](std::size_t job, const JobResult&) { ended.push_back(job); });
  }

  /// A script that ends when the file is there, or fails after some seconds.
  std::string wait_for(const std::string& file) const {
    return "for i in $(seq 500); do test -e '" + folder / file + "' && exit 0; sleep 0.02; done; " +
           "exit 5";
  }
  std::string touch(const std::string& file) const { return ": > '" + folder / file + "'; "; }

  const TemporaryFolder folder;
  std::vector<std::size_t> ended;

 private:
  int logs_ = 0;
};

TEST_F(ProcessPool, RunsAllInOrderOneAtATime) {
  // Were two there at once, the second could not make the folder.
  const std::string alone =
      "mkdir '" + folder / "lock" + "' && sleep 0.02 && rmdir '" + folder / "lock" + "'";
  const PoolResult result = run({shell(alone), shell(alone), shell(alone)}, 1);
  for (const JobResult& job : result.jobs) EXPECT_EQ(job.status, JobStatus::succeeded);
  EXPECT_THAT(ended, ElementsAre(0, 1, 2));
  EXPECT_FALSE(result.stopped_by);
}

TEST_F(ProcessPool, RunsSeveralAtATime) {
  const PoolResult result =
      run({shell(touch("a") + wait_for("b")), shell(touch("b") + wait_for("a"))}, 2);
  for (const JobResult& job : result.jobs) EXPECT_EQ(job.status, JobStatus::succeeded);
}

TEST_F(ProcessPool, AFailureIsToldWithItsLastLineAndStopsNoOther) {
  const PoolResult result = run({shell("echo first >&2; echo last >&2; exit 3"), shell("exit 4"),
                                 shell("kill -KILL $$"), shell("echo fine >&2")},
                                2);
  EXPECT_EQ(result.jobs[0].status, JobStatus::failed);
  EXPECT_EQ(result.jobs[0].exit_code, 3);
  EXPECT_EQ(result.jobs[0].message, "last");
  EXPECT_EQ(result.jobs[1].exit_code, 4);
  EXPECT_EQ(result.jobs[1].message, "it said nothing");
  EXPECT_EQ(result.jobs[2].exit_code, -1);
  EXPECT_EQ(result.jobs[2].message, "ended by: Killed");
  EXPECT_EQ(result.jobs[3].status, JobStatus::succeeded);
  EXPECT_EQ(result.jobs[3].message, "");
}

TEST_F(ProcessPool, AJobWaitsForAnother) {
  std::vector<Job> jobs{shell("sleep 0.05; " + touch("made")),
                        shell("test -e '" + folder / "made" + "'"), shell("exit 3"),
                        shell("exit 0"), shell("exit 0")};
  jobs[1].after = 0;
  jobs[3].after = 2;
  jobs[4].after = 3;
  const PoolResult result = run(jobs, 2);
  EXPECT_EQ(result.jobs[1].status, JobStatus::succeeded);
  EXPECT_EQ(result.jobs[2].status, JobStatus::failed);
  EXPECT_EQ(result.jobs[3].status, JobStatus::not_run);
  EXPECT_EQ(result.jobs[4].status, JobStatus::not_run) << "nor what waits for what was not run";
  EXPECT_THAT(ended, testing::UnorderedElementsAre(0, 1, 2));
}

TEST_F(ProcessPool, JobsReadNothingAndPrintNothing) {
  testing::internal::CaptureStdout();
  const PoolResult result = run({shell("cat; echo printed")}, 1);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(result.jobs[0].status, JobStatus::succeeded);
}

TEST_F(ProcessPool, ASignalStopsWhatRunsAndStartsNothingMore) {
  std::vector<Job> jobs{shell("true"), shell("kill -TERM $PPID; exec sleep 60"),
                        shell("exec sleep 60"), shell(touch("too-late"))};
  jobs[1].after = 0;
  const PoolResult result = run(jobs, 2);
  EXPECT_EQ(result.stopped_by, SIGTERM);
  EXPECT_EQ(result.jobs[0].status, JobStatus::succeeded);
  EXPECT_EQ(result.jobs[1].status, JobStatus::not_run);
  EXPECT_EQ(result.jobs[3].status, JobStatus::not_run);
  EXPECT_FALSE(std::filesystem::exists(folder / "too-late"));
}

TEST_F(ProcessPool, ASecondSignalKillsWhatDoesNotStop) {
  const auto run_stubborn = [this] {
    sigset_t term;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    ::pthread_sigmask(SIG_BLOCK, &term, nullptr);  // one more may come after the pool's end
    const PoolResult result =
        run({shell("trap '' TERM; while :; do kill -TERM $PPID; sleep 0.02; done")}, 1);
    std::_Exit(result.stopped_by == SIGTERM ? 0 : 1);
  };
  EXPECT_EXIT(run_stubborn(), testing::ExitedWithCode(0), "");
}

TEST_F(ProcessPool, RefusesAProgramThatCannotBeStarted) {
  const std::vector<Job> jobs{{"/no/such/program", {}, folder / "log", std::nullopt}};
  EXPECT_THAT(message_of<InputError>([&] { run(jobs, 1); }),
              testing::AllOf(HasSubstr("/no/such/program"), HasSubstr("cannot be started")));
}

}  // namespace
}  // namespace nbvopt::test
