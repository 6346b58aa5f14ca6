#include "study/coordinator.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <deque>
#include <limits>
#include <memory>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "study/worker_process.hpp"

namespace nbvopt::study {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostAttempts = 2;  ///< a worker may have been killed for another's fault
constexpr double kHelloTimeout_s = 60.0;
constexpr int kMostLostAtStart = 5;  ///< of a command that has started workers before

/// SIGINT and SIGTERM as something to wait for, while it lives; SIGPIPE is ignored meanwhile, and
/// SIGCHLD is not.
class StopSignals {
 public:
  StopSignals() {
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGINT);
    sigaddset(&held, SIGTERM);
    ::pthread_sigmask(SIG_BLOCK, &held, &before_);
    descriptor_ = Descriptor(::signalfd(-1, &held, SFD_CLOEXEC | SFD_NONBLOCK));
    pipe_before_ = std::signal(SIGPIPE, SIG_IGN);
    // A parent may have told us to ignore it: workers would then vanish unseen.
    child_before_ = std::signal(SIGCHLD, SIG_DFL);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals() {
    std::signal(SIGCHLD, child_before_);
    std::signal(SIGPIPE, pipe_before_);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

  int descriptor() const { return descriptor_.get(); }
  const sigset_t& before() const { return before_; }

  std::optional<int> take() const {
    signalfd_siginfo info{};
    if (::read(descriptor_.get(), &info, sizeof info) != sizeof info) return std::nullopt;
    return static_cast<int>(info.ssi_signo);
  }

 private:
  sigset_t before_{};
  Descriptor descriptor_{-1};
  void (*pipe_before_)(int) = SIG_DFL;
  void (*child_before_)(int) = SIG_DFL;
};

/// A unit that waits for a worker or is at work.
struct Task {
  std::size_t unit = 0;
  int attempt = 1;
};

/// One of the processes that work side by side.
struct Worker {
  std::unique_ptr<WorkerProcess> process;  ///< null: ended, and no work is left for another
  bool has_said_hello = false;
  std::optional<Task> task;
  std::string id;  ///< of the task's unit
  Clock::time_point deadline;

  bool is_waited_for() const { return process && (task.has_value() || !has_said_hello); }
};

/// Whether a line of a worker answers this unit, in one of the protocol's two ways.
bool is_answer(const Json& message, const std::string& id) {
  if (!message.is_object() || message.value("unit", Json()) != id) return false;
  if (!message.value("busy_ms", Json()).is_number()) return false;
  const Json answer = message.value("answer", Json());
  const Json failure = message.value("failure", Json());
  if (!answer.is_null()) return answer.is_object() && failure.is_null();
  return failure.is_string() && failure != "";
}

class Coordinator {
 public:
  Coordinator(std::size_t count, const std::function<WorkUnit(std::size_t)>& unit_at,
              const CoordinatorOptions& options,
              const std::function<void(std::size_t, const WorkOutcome&)>& on_end)
      : count_(count), unit_at_(unit_at), options_(options), on_end_(on_end) {}

  CoordinatorResult run();

 private:
  bool has_more() const { return !result_.stopped_by && (next_ < count_ || !again_.empty()); }
  Task take_task();
  void start(Worker& worker);
  void hand_out(Worker& worker);
  bool wait();
  void hear(Worker& worker);
  void hear_line(Worker& worker, const std::string& line);
  void lose(Worker& worker);
  void stop_late(Worker& worker);
  void end(const Task& task, const WorkOutcome& outcome);
  int milliseconds_to_wait() const;

  std::size_t count_;
  const std::function<WorkUnit(std::size_t)>& unit_at_;
  const CoordinatorOptions& options_;
  const std::function<void(std::size_t, const WorkOutcome&)>& on_end_;
  StopSignals signals_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0;
  std::deque<Task> again_;           ///< whose workers have ended with them
  bool has_heard_a_worker_ = false;  ///< the command does start workers
  int lost_at_start_ = 0;            ///< workers that ended before their first line, since then
  CoordinatorResult result_;
};

CoordinatorResult Coordinator::run() {
  const Clock::time_point begin = Clock::now();
  workers_.resize(std::min(options_.workers, count_));
  for (Worker& worker : workers_) start(worker);
  while (std::ranges::any_of(workers_, &Worker::is_waited_for)) {
    if (!wait()) break;
  }
  result_.wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  return result_;
}

Task Coordinator::take_task() {
  if (again_.empty()) return {next_++};
  const Task task = again_.front();
  again_.pop_front();
  return task;
}

void Coordinator::start(Worker& worker) {
  worker = {};
  if (!has_more()) return;
  worker.process = std::make_unique<WorkerProcess>(options_.worker_command, signals_.before());
  worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(kHelloTimeout_s));
}

void Coordinator::hand_out(Worker& worker) {
  if (!has_more()) return;
  worker.task = take_task();
  worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(options_.timeout_s));
  // One that has ended is noticed when its line out ends.
  const WorkUnit unit = unit_at_(worker.task->unit);
  worker.id = unit.id;
  worker.process->send(to_line(unit));
}

int Coordinator::milliseconds_to_wait() const {
  Clock::time_point first = Clock::time_point::max();
  for (const Worker& worker : workers_) {
    if (worker.is_waited_for()) first = std::min(first, worker.deadline);
  }
  const std::chrono::duration<double, std::milli> left = first - Clock::now();
  constexpr double kLongest = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::ceil(left.count()), 0.0, kLongest));
}

/// False when everything is to be dropped.
bool Coordinator::wait() {
  std::vector<pollfd> descriptors{{signals_.descriptor(), POLLIN, 0}};
  for (const Worker& worker : workers_) {
    // poll() passes over negative ones.
    descriptors.push_back({worker.process ? worker.process->descriptor() : -1, POLLIN, 0});
  }
  ::poll(descriptors.data(), descriptors.size(), milliseconds_to_wait());
  // First: who stops all processes of a group stops the workers as well.
  if (const auto signal = signals_.take()) {
    if (result_.stopped_by) return false;
    result_.stopped_by = signal;
  }
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    Worker& worker = workers_[i];
    if (descriptors[i + 1].revents != 0) {
      hear(worker);
    } else if (worker.is_waited_for() && Clock::now() >= worker.deadline) {
      stop_late(worker);
    }
  }
  return true;
}

void Coordinator::hear(Worker& worker) {
  const bool is_open = worker.process->lines().read_some();
  while (const auto line = worker.process->lines().next_line()) hear_line(worker, *line);
  if (!is_open) lose(worker);
}

void Coordinator::hear_line(Worker& worker, const std::string& line) {
  // Garbage is the fault of a program that is no worker.
  const Json message = Json::parse(line, nullptr, false);
  if (!worker.has_said_hello) {
    if (!message.is_object() || message.value("protocol", Json()) != kProtocolVersion) {
      throw InputError(options_.worker_command.front() + ": is no worker that speaks protocol " +
                       std::to_string(kProtocolVersion) + ": " + line.substr(0, 80));
    }
    worker.has_said_hello = true;
    has_heard_a_worker_ = true;
    hand_out(worker);
    return;
  }
  if (!worker.task || !is_answer(message, worker.id)) {
    throw InputError(options_.worker_command.front() +
                     ": a worker wrote what is no answer: " + line.substr(0, 80));
  }
  const Task task = *worker.task;
  worker.task.reset();
  hand_out(worker);  // first: it works while its answer is kept
  const double busy_ms = message.at("busy_ms").get<double>();
  result_.busy_ms += busy_ms;
  end(task, {message.value("answer", Json()), message.value("failure", ""), busy_ms});
}

void Coordinator::lose(Worker& worker) {
  const std::string how = worker.process->end();
  const std::optional<Task> task = worker.task;
  if (!worker.has_said_hello && (!has_heard_a_worker_ || ++lost_at_start_ == kMostLostAtStart)) {
    throw InputError(options_.worker_command.front() +
                     ": a worker ended before its first line: " + how);
  }
  if (result_.stopped_by) {
    worker = {};  // perhaps stopped by the same hand; its unit is run by the next study
    return;
  }
  if (task && task->attempt < kMostAttempts) {
    again_.push_back({task->unit, task->attempt + 1});
  } else if (task) {
    end(*task, {Json(), "its worker ended, twice: " + how, 0.0});
  }
  start(worker);
}

void Coordinator::stop_late(Worker& worker) {
  worker.process->end();
  if (!worker.has_said_hello) {
    throw InputError(options_.worker_command.front() + ": a worker said nothing for " +
                     format_number(kHelloTimeout_s) + " s");
  }
  end(*worker.task,
      {Json(), "stopped by the watchdog after " + format_number(options_.timeout_s) + " s",
       options_.timeout_s * 1e3});
  start(worker);
}

void Coordinator::end(const Task& task, const WorkOutcome& outcome) {
  ++result_.finished;
  if (!outcome.failure.empty()) ++result_.failed;
  on_end_(task.unit, outcome);
}

}  // namespace

CoordinatorResult run_units(
    std::size_t count, const std::function<WorkUnit(std::size_t index)>& unit_at,
    const CoordinatorOptions& options,
    const std::function<void(std::size_t index, const WorkOutcome& outcome)>& on_end) {
  if (count == 0) return {};
  return Coordinator(count, unit_at, options, on_end).run();
}

}  // namespace nbvopt::study
