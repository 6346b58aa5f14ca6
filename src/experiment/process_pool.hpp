// Workers that are processes of this machine: one that hangs can be stopped.
#pragma once

#include <csignal>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/pool.hpp"
#include "experiment/worker_process.hpp"

namespace nbvopt::experiment {

/// Processes that speak the workers' protocol. While it lives, SIGPIPE is ignored and SIGCHLD is
/// not.
class ProcessPool final : public Pool {
 public:
  /// Workers are to be started by this command, a program and its arguments. They get the signals
  /// that the caller's thread has now.
  ProcessPool(std::vector<std::string> command, std::size_t workers);
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;
  ~ProcessPool() override;

  std::size_t size() const override { return workers_.size(); }
  void start(std::size_t worker) override;
  void hand_out(std::size_t worker, std::span<const Unit> units) override;
  void stop(std::size_t worker) override;
  std::vector<PoolEvent> wait(Clock::time_point until, int wake) override;

 private:
  struct Worker {
    std::unique_ptr<WorkerProcess> process;  ///< null: not started
    bool has_said_hello = false;
    Clock::time_point hello_deadline;
    std::optional<std::string> unit;  ///< the id of the one that it is at
  };

  void hear(std::size_t index, std::vector<PoolEvent>& events);
  PoolEvent event_of(std::size_t index, const std::string& line);
  PoolEvent lose(std::size_t index);
  [[noreturn]] void fail(const std::string& what) const;

  std::vector<std::string> command_;
  std::vector<Worker> workers_;
  sigset_t signals_{};
  void (*pipe_before_)(int) = SIG_DFL;
  void (*child_before_)(int) = SIG_DFL;
  bool has_heard_a_worker_ = false;  ///< the command does start workers
  int lost_at_start_ = 0;            ///< workers that ended before their first line, since then
};

}  // namespace nbvopt::experiment
