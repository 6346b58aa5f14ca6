#include "experiment/process_pool.hpp"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/number.hpp"
#include "experiment/protocol.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {
namespace {

constexpr std::chrono::seconds kHelloTimeout(60);
constexpr int kMostLostAtStart = 5;  ///< of a command that has started workers before

int milliseconds_until(Pool::Clock::time_point time) {
  const std::chrono::duration<double, std::milli> left = time - Pool::Clock::now();
  constexpr double kLongest = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(std::ceil(left.count()), 0.0, kLongest));
}

}  // namespace

ProcessPool::ProcessPool(std::vector<std::string> command, std::size_t workers)
    : command_(std::move(command)), workers_(workers) {
  ::pthread_sigmask(SIG_SETMASK, nullptr, &signals_);
  pipe_before_ = std::signal(SIGPIPE, SIG_IGN);
  // A parent may have told us to ignore it: workers would then vanish unseen.
  child_before_ = std::signal(SIGCHLD, SIG_DFL);
}

ProcessPool::~ProcessPool() {
  workers_.clear();
  std::signal(SIGCHLD, child_before_);
  std::signal(SIGPIPE, pipe_before_);
}

void ProcessPool::start(std::size_t worker) {
  Worker& started = workers_[worker];
  started = {};
  started.process = std::make_unique<WorkerProcess>(command_, signals_);
  started.hello_deadline = Clock::now() + kHelloTimeout;
}

void ProcessPool::hand_out(std::size_t worker, std::span<const Unit> units) {
  if (!workers_[worker].process) return;  // lost since it was ready
  const Unit& unit = units.front();       // one at a time
  workers_[worker].unit = unit.id;
  workers_[worker].process->send(unit_line(unit));
}

void ProcessPool::stop(std::size_t worker) { workers_[worker] = {}; }

std::vector<PoolEvent> ProcessPool::wait(Clock::time_point until, int wake) {
  std::vector<pollfd> descriptors{{wake, POLLIN, 0}};
  for (const Worker& worker : workers_) {
    // poll() passes over negative ones.
    descriptors.push_back({worker.process ? worker.process->descriptor() : -1, POLLIN, 0});
    if (worker.process && !worker.has_said_hello) until = std::min(until, worker.hello_deadline);
  }
  ::poll(descriptors.data(), descriptors.size(), milliseconds_until(until));
  std::vector<PoolEvent> events;
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    const Worker& worker = workers_[i];
    if (descriptors[i + 1].revents != 0) {
      hear(i, events);
    } else if (worker.process && !worker.has_said_hello && Clock::now() >= worker.hello_deadline) {
      fail("a worker said nothing for " +
           format_number(std::chrono::duration<double>(kHelloTimeout).count()) + " s");
    }
  }
  return events;
}

void ProcessPool::hear(std::size_t index, std::vector<PoolEvent>& events) {
  LineReader& lines = workers_[index].process->lines();
  const bool is_open = lines.read_some();
  while (const auto line = lines.next_line()) events.push_back(event_of(index, *line));
  if (!is_open) events.push_back(lose(index));
}

PoolEvent ProcessPool::event_of(std::size_t index, const std::string& line) {
  Worker& worker = workers_[index];
  // Garbage is the fault of a program that is no worker.
  if (!worker.has_said_hello) {
    if (!is_hello(line)) {
      fail("is no worker that speaks protocol " + std::to_string(kProtocolVersion) + ": " +
           line.substr(0, 80));
    }
    worker.has_said_hello = true;
    has_heard_a_worker_ = true;
    return {.worker = index, .kind = PoolEvent::Kind::ready};
  }
  std::optional<AnsweredUnit> answered = parse_answer(line);
  if (!answered || answered->id != worker.unit) {
    fail("a worker wrote what is no answer: " + line.substr(0, 80));
  }
  worker.unit.reset();
  return {
      .worker = index, .kind = PoolEvent::Kind::answered, .outcome = std::move(answered->outcome)};
}

PoolEvent ProcessPool::lose(std::size_t index) {
  const std::string how = workers_[index].process->end();
  if (!workers_[index].has_said_hello &&
      (!has_heard_a_worker_ || ++lost_at_start_ == kMostLostAtStart)) {
    fail("a worker ended before its first line: " + how);
  }
  workers_[index] = {};
  return {.worker = index, .kind = PoolEvent::Kind::lost, .how = how};
}

void ProcessPool::fail(const std::string& what) const {
  throw InputError(command_.front() + ": " + what);
}

}  // namespace nbvopt::experiment
