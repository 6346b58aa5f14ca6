// Commands as child processes, some at a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nbvopt {

/// A command to run. It reads nothing and its standard output is dropped.
struct Job {
  std::string program;
  std::vector<std::string> arguments;
  std::filesystem::path log_file;    ///< takes its standard error, emptied first
  std::optional<std::size_t> after;  ///< an earlier job that must have succeeded
};

enum class JobStatus {
  not_run,  ///< the job before it failed, or the pool was stopped
  succeeded,
  failed,
};

/// How a job ended.
struct JobResult {
  JobStatus status = JobStatus::not_run;
  int exit_code = -1;   ///< -1 when a signal ended it, or when it was not run
  std::string message;  ///< of a failed one: the last line of its log
};

/// How all of them ended.
struct PoolResult {
  std::vector<JobResult> jobs;    ///< one a job, in their order
  std::optional<int> stopped_by;  ///< SIGINT or SIGTERM; none: all were run that could be
};

/// Runs the jobs in their order, at most so many at a time; one that fails does not stop the
/// others. `on_end` is told of each job that has ended, in the order of their ends. SIGINT and
/// SIGTERM, which are held back meanwhile, stop the running jobs; sent again, they kill them.
/// To be called by a process's only thread, or with both signals blocked in all others. Throws
/// InputError when a program cannot be started; then nothing is left running.
PoolResult run_jobs(std::span<const Job> jobs, std::size_t at_a_time,
                    const std::function<void(std::size_t job, const JobResult&)>& on_end);

}  // namespace nbvopt
