#include "experiment/job_pool.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <map>
#include <system_error>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// Holds back the signals that the pool waits for, while it lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGCHLD, SIGINT, SIGTERM}) sigaddset(&held_, signal);
    ::pthread_sigmask(SIG_BLOCK, &held_, &before_);
    // A parent may have told us to ignore it: children would then vanish unseen.
    child_before_ = std::signal(SIGCHLD, SIG_DFL);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() {
    std::signal(SIGCHLD, child_before_);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

  int wait() const {
    int signal = -1;
    while (signal < 0) signal = ::sigwaitinfo(&held_, nullptr);
    return signal;
  }
  const sigset_t& before() const { return before_; }

 private:
  sigset_t held_;
  sigset_t before_;
  void (*child_before_)(int) = SIG_DFL;
};

/// Starts a job with the signals that its parent was given.
pid_t start(const Job& job, const sigset_t& signals) {
  std::vector<char*> argv{const_cast<char*>(job.program.c_str())};
  for (const std::string& argument : job.arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, job.log_file.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&attributes, &signals);
  pid_t pid = 0;
  const int error =
      ::posix_spawn(&pid, job.program.c_str(), &files, &attributes, argv.data(), ::environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    throw InputError(job.program + " with its log in " + job.log_file.string() +
                     ": cannot be started: " + std::generic_category().message(error));
  }
  return pid;
}

std::string last_line(const std::filesystem::path& file) {
  try {
    std::string text = read_text_file(file);
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  } catch (const InputError&) {
    return "it said nothing";  // an empty log counts as unreadable
  }
}

JobResult result_of(const Job& job, int wait_status) {
  if (WIFSIGNALED(wait_status)) {
    return {JobStatus::failed, -1, std::string("ended by: ") + ::strsignal(WTERMSIG(wait_status))};
  }
  const int exit_code = WEXITSTATUS(wait_status);
  if (exit_code == 0) return {JobStatus::succeeded, 0, {}};
  return {JobStatus::failed, exit_code, last_line(job.log_file)};
}

/// The children that run now; none outlives it.
class Children {
 public:
  Children() = default;
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  ~Children() {
    send(SIGKILL);
    for (const auto& [pid, job] : jobs_) ::waitpid(pid, nullptr, 0);
  }

  std::size_t count() const { return jobs_.size(); }
  void add(pid_t pid, std::size_t job) { jobs_.emplace(pid, job); }
  void send(int signal) const {
    for (const auto& [pid, job] : jobs_) ::kill(pid, signal);
  }

  /// Takes out those that have ended and calls with the job and its wait status.
  template <class OnEnd>
  void reap(const OnEnd& on_end) {
    for (auto child = jobs_.begin(); child != jobs_.end();) {
      int wait_status = 0;
      if (::waitpid(child->first, &wait_status, WNOHANG) <= 0) {
        ++child;
        continue;
      }
      const std::size_t job = child->second;
      child = jobs_.erase(child);
      on_end(job, wait_status);
    }
  }

 private:
  std::map<pid_t, std::size_t> jobs_;
};

/// Which jobs can be started, in their order.
class Queue {
 public:
  Queue(std::span<const Job> jobs, const std::vector<JobResult>& results)
      : jobs_(jobs), results_(results), is_started_(jobs.size(), false) {}

  /// The first job whose predecessor, if any, has succeeded; none when there is none now.
  std::optional<std::size_t> take() {
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (is_started_[i]) continue;
      if (jobs_[i].after && results_[*jobs_[i].after].status != JobStatus::succeeded) continue;
      is_started_[i] = true;
      return i;
    }
    return std::nullopt;
  }

 private:
  std::span<const Job> jobs_;
  const std::vector<JobResult>& results_;
  std::vector<bool> is_started_;
};

}  // namespace

PoolResult run_jobs(std::span<const Job> jobs, std::size_t at_a_time,
                    const std::function<void(std::size_t job, const JobResult&)>& on_end) {
  PoolResult pool;
  pool.jobs.resize(jobs.size());
  Queue queue(jobs, pool.jobs);
  const HeldSignals signals;
  Children children;
  while (true) {
    while (!pool.stopped_by && children.count() < at_a_time) {
      const auto job = queue.take();
      if (!job) break;
      children.add(start(jobs[*job], signals.before()), *job);
    }
    if (children.count() == 0) return pool;
    const int signal = signals.wait();
    if (signal != SIGCHLD) {
      children.send(pool.stopped_by ? SIGKILL : SIGTERM);
      pool.stopped_by = signal;
      continue;
    }
    children.reap([&](std::size_t job, int wait_status) {
      const JobResult result = result_of(jobs[job], wait_status);
      if (pool.stopped_by && result.status == JobStatus::failed) return;  // it was told to end
      pool.jobs[job] = result;
      on_end(job, result);
    });
  }
}

}  // namespace nbvopt
