#include "experiment/coordinator.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <deque>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/descriptor.hpp"
#include "core/number.hpp"
#include "core/stopwatch.hpp"

namespace nbvopt::experiment {
namespace {

using Clock = Pool::Clock;

constexpr int kMostAttempts = 2;  ///< a worker may have been killed for another's fault

/// So much work a worker is given at a time: a hundred times what it takes to get the next from
/// another machine, and no more than is worth losing.
constexpr double kWorkAhead_ms = 100.0;

/// SIGINT and SIGTERM as something to wait for, while it lives.
class StopSignals {
 public:
  StopSignals() {
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGINT);
    sigaddset(&held, SIGTERM);
    ::pthread_sigmask(SIG_BLOCK, &held, &before_);
    descriptor_ = Descriptor(::signalfd(-1, &held, SFD_CLOEXEC | SFD_NONBLOCK));
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  ~StopSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

  int descriptor() const { return descriptor_.get(); }

  std::optional<int> take() const {
    signalfd_siginfo info{};
    if (::read(descriptor_.get(), &info, sizeof info) != sizeof info) return std::nullopt;
    return static_cast<int>(info.ssi_signo);
  }

 private:
  sigset_t before_{};
  Descriptor descriptor_{-1};
};

/// A unit that waits for a worker or is at work, by its place among those to do.
struct Task {
  std::size_t place = 0;
  int attempt = 1;
};

/// Which units can be handed out, in about their order.
class Queue {
 public:
  Queue(const Work& work, std::span<const std::size_t> to_do)
      : work_(work), to_do_(to_do), has_succeeded_(to_do.size(), false) {}

  /// Whether there may be something to take.
  bool has_more() const { return !again_.empty() || next_ < to_do_.size(); }

  std::optional<Task> take() {
    if (!again_.empty()) {
      const Task task = again_.front();
      again_.pop_front();
      return task;
    }
    while (next_ < to_do_.size()) {
      const std::size_t place = next_++;
      const std::optional<std::size_t> awaited = predecessor(place);
      if (!awaited || has_succeeded_[*awaited]) return Task{place};
      waiting_[*awaited].push_back(place);
    }
    return std::nullopt;
  }

  void put_back(const Task& task) { again_.push_back(task); }

  /// How many can be taken at most.
  std::size_t size() const { return again_.size() + to_do_.size() - next_; }

  /// Those that have waited for this one wait no longer.
  void succeed(std::size_t place) {
    has_succeeded_[place] = true;
    const auto waiting = waiting_.extract(place);
    if (!waiting) return;
    for (const std::size_t successor : waiting.mapped()) again_.push_back({successor});
  }

 private:
  /// None when there is none, or when an earlier run has done it.
  std::optional<std::size_t> predecessor(std::size_t place) const {
    const std::optional<std::size_t> index = work_.predecessor(to_do_[place]);
    if (!index) return std::nullopt;
    const auto found = std::ranges::lower_bound(to_do_, *index);
    if (found == to_do_.end() || *found != *index) return std::nullopt;
    return static_cast<std::size_t>(found - to_do_.begin());
  }

  const Work& work_;
  std::span<const std::size_t> to_do_;
  std::vector<bool> has_succeeded_;
  std::size_t next_ = 0;
  std::deque<Task> again_;  ///< passed over once: they have waited, or have lost their worker
  std::unordered_map<std::size_t, std::vector<std::size_t>> waiting_;  ///< by what they wait for
};

/// What is known of a worker.
struct Worker {
  enum class State { stopped, starting, running };

  State state = State::stopped;
  std::deque<Task> tasks = {};      ///< that it has been given; it is at the first
  Clock::time_point deadline = {};  ///< of that one

  bool is_at_work() const { return !tasks.empty(); }
};

/// How long units take that are about to be handed out, by those before.
class UnitTimes {
 public:
  void add(double busy_ms) {
    slow_ms_ = std::isinf(slow_ms_) ? busy_ms : std::max(busy_ms, kMemory * slow_ms_);
  }

  /// How many of them make so much work: of units short and long, few.
  std::size_t count_in(double work_ms, std::size_t most) const {
    constexpr double kLeast_ms = 1e-6;  // where workers tell of no time at all
    const double count = work_ms / std::max(slow_ms_, kLeast_ms);
    return static_cast<std::size_t>(std::clamp(count, 1.0, static_cast<double>(most)));
  }

 private:
  static constexpr double kMemory = 0.95;                     ///< a slow one is forgotten by and by
  double slow_ms_ = std::numeric_limits<double>::infinity();  ///< before any has ended
};

class Coordinator {
 public:
  Coordinator(Work& work, std::span<const std::size_t> to_do, double timeout_s, Pool& pool,
              RecordFile& records, const std::function<void(const Json&)>& on_record,
              const std::function<void(std::size_t)>& on_stop)
      : work_(work),
        to_do_(to_do),
        timeout_s_(timeout_s),
        pool_(pool),
        records_(records),
        on_record_(on_record),
        on_stop_(on_stop),
        queue_(work, to_do),
        workers_(std::min(pool.size(), to_do.size())) {}

  RunResult run();

 private:
  bool hands_out() const { return !result_.stopped_by && queue_.has_more(); }
  bool is_over() const;
  std::size_t units_at_work() const;
  void employ(std::size_t index);
  std::size_t units_a_worker() const;
  void hand_out(std::size_t index);
  void start_clock(Worker& worker) const;
  void put_back_rest(Worker& worker);
  bool wait();
  void take(const PoolEvent& event);
  void lose(const PoolEvent& event);
  void stop_late(std::size_t index);
  void end(const Task& task, const Outcome& outcome);

  Work& work_;
  std::span<const std::size_t> to_do_;
  double timeout_s_;
  Pool& pool_;
  RecordFile& records_;
  const std::function<void(const Json&)>& on_record_;
  const std::function<void(std::size_t)>& on_stop_;
  StopSignals signals_;
  Queue queue_;
  UnitTimes unit_times_;
  std::vector<Worker> workers_;
  RunResult result_;
};

RunResult Coordinator::run() {
  const Stopwatch stopwatch;
  do {
    for (std::size_t i = 0; i < workers_.size(); ++i) employ(i);
  } while (!is_over() && wait());
  result_.wall_ms = stopwatch.elapsed_ms();
  return result_;
}

bool Coordinator::is_over() const { return !hands_out() && units_at_work() == 0; }

std::size_t Coordinator::units_at_work() const {
  return std::accumulate(
      workers_.begin(), workers_.end(), std::size_t{0},
      [](std::size_t units, const Worker& worker) { return units + worker.tasks.size(); });
}

/// Gives it something to do, if there is.
void Coordinator::employ(std::size_t index) {
  Worker& worker = workers_[index];
  if (worker.state == Worker::State::running && !worker.is_at_work()) hand_out(index);
  if (worker.state != Worker::State::stopped || !hands_out()) return;
  pool_.start(index);
  worker.state = Worker::State::starting;
}

/// How many units a worker should have: so many that it need not wait for the next, and towards the
/// end fewer, so that all end at about the same time.
std::size_t Coordinator::units_a_worker() const {
  const std::size_t share = queue_.size() / (2 * workers_.size());
  const std::size_t most = std::min(pool_.most_units_a_worker(), share);
  return unit_times_.count_in(kWorkAhead_ms, std::max<std::size_t>(most, 1));
}

void Coordinator::hand_out(std::size_t index) {
  Worker& worker = workers_[index];
  const std::size_t wanted = units_a_worker();
  if (2 * worker.tasks.size() > wanted) return;  // it has enough, and messages are to be few
  const bool was_at_work = worker.is_at_work();
  std::vector<Unit> units;
  while (worker.tasks.size() < wanted && hands_out()) {
    const std::optional<Task> task = queue_.take();
    if (!task) break;
    worker.tasks.push_back(*task);
    units.push_back(work_.unit(to_do_[task->place]));
  }
  if (units.empty()) return;
  if (!was_at_work) start_clock(worker);
  pool_.hand_out(index, units);
}

void Coordinator::start_clock(Worker& worker) const {
  worker.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(timeout_s_));
}

/// False when everything is to be dropped.
bool Coordinator::wait() {
  Clock::time_point first = Clock::time_point::max();
  for (const Worker& worker : workers_) {
    if (worker.is_at_work()) first = std::min(first, worker.deadline);
  }
  const std::vector<PoolEvent> events = pool_.wait(first, signals_.descriptor());
  // First: who stops all processes of a group stops the workers as well.
  if (const auto signal = signals_.take()) {
    if (result_.stopped_by) return false;
    result_.stopped_by = signal;
    if (on_stop_ && units_at_work() > 0) on_stop_(units_at_work());
  }
  for (const PoolEvent& event : events) take(event);
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    const Worker& worker = workers_[i];
    if (worker.is_at_work() && Clock::now() >= worker.deadline) stop_late(i);
  }
  return true;
}

void Coordinator::take(const PoolEvent& event) {
  if (event.kind == PoolEvent::Kind::lost) return lose(event);
  Worker& worker = workers_[event.worker];
  worker.state = Worker::State::running;
  std::optional<Task> ended;
  if (event.kind == PoolEvent::Kind::answered) {
    ended = worker.tasks.front();
    worker.tasks.pop_front();
    if (worker.is_at_work()) start_clock(worker);
    unit_times_.add(event.outcome.busy_ms);
  }
  hand_out(event.worker);  // first: it works while its answer is kept
  if (!ended) return;
  result_.busy_ms += event.outcome.busy_ms;
  end(*ended, event.outcome);
}

/// What a worker has not begun that has ended is another's.
void Coordinator::put_back_rest(Worker& worker) {
  for (const Task& task : worker.tasks) queue_.put_back(task);
  worker.tasks.clear();
}

void Coordinator::lose(const PoolEvent& event) {
  Worker& worker = workers_[event.worker];
  worker.state = Worker::State::stopped;
  if (!worker.is_at_work()) return;
  const Task task = worker.tasks.front();
  worker.tasks.pop_front();
  put_back_rest(worker);
  // After a stop perhaps by the same hand: the unit is run by the next run.
  if (result_.stopped_by) return;
  if (task.attempt < kMostAttempts) {
    queue_.put_back({task.place, task.attempt + 1});
  } else {
    end(task, {.answer = Json(), .failure = "its worker ended, twice: " + event.how});
  }
}

void Coordinator::stop_late(std::size_t index) {
  pool_.stop(index);
  Worker& worker = workers_[index];
  worker.state = Worker::State::stopped;
  const Task task = worker.tasks.front();
  worker.tasks.pop_front();
  put_back_rest(worker);
  end(task, {.answer = Json(),
             .failure = "stopped by the watchdog after " + format_number(timeout_s_) + " s",
             .busy_ms = timeout_s_ * 1e3});
}

void Coordinator::end(const Task& task, const Outcome& outcome) {
  ++result_.finished;
  const bool has_failed = !outcome.failure.empty();
  if (has_failed) ++result_.failed;
  const Json record = work_.record(to_do_[task.place], outcome);
  records_.append(record);
  if (!has_failed) queue_.succeed(task.place);
  on_record_(record);
}

}  // namespace

RunResult run_units(Work& work, std::span<const std::size_t> to_do, double timeout_s, Pool& pool,
                    RecordFile& records, const std::function<void(const Json& record)>& on_record,
                    const std::function<void(std::size_t units)>& on_stop) {
  if (to_do.empty()) return {};
  return Coordinator(work, to_do, timeout_s, pool, records, on_record, on_stop).run();
}

}  // namespace nbvopt::experiment
