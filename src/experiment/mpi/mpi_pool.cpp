#include "experiment/mpi/mpi_pool.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <exception>
#include <fstream>
#include <sstream>

#include "core/json.hpp"
#include "experiment/process_pool.hpp"
#include "experiment/protocol.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {
namespace {

/// What messages are about. Those about a worker begin with its life, a number and a blank.
namespace tag {
enum Tag : int {
  // to a rank
  start,
  units,  ///< lines of units, to be done after those before
  stop,
  file,  ///< its path alone
  go_home,
  // from a rank
  ready,
  answer,  ///< an answer's line
  lost,    ///< how it ended
  seen,    ///< a file; nothing else
  failed,  ///< what no worker would do
};
}  // namespace tag

/// MPI has nothing to wait on beside other things, so that we look again and again, at ever longer
/// intervals while nothing comes.
class Backoff {
 public:
  /// Waits for the next look, or until the descriptor is readable: then it is true.
  bool wait(int descriptor) {
    pollfd wake{descriptor, POLLIN, 0};
    const std::timespec interval{0, interval_ns_};
    interval_ns_ = std::min(2 * interval_ns_, kLongest_ns);
    return ::ppoll(&wake, 1, &interval, nullptr) > 0;
  }

 private:
  static constexpr long kLongest_ns = 250'000;
  long interval_ns_ = 20'000;
};

std::string with_life(std::uint64_t life, const std::string& text) {
  return std::to_string(life) + ' ' + text;
}

struct Told {
  std::uint64_t life = 0;
  std::string text;
};

Told told_in(const std::string& bytes) {
  const std::size_t blank = bytes.find(' ');
  return {std::stoull(bytes.substr(0, blank)), bytes.substr(blank + 1)};
}

}  // namespace

MpiPool::MpiPool(MpiSession& session)
    : session_(session), workers_(static_cast<std::size_t>(session.size() - 1)) {}

MpiPool::~MpiPool() {
  for (int rank = 1; rank < session_.size(); ++rank) session_.send(rank, tag::go_home, {});
}

void MpiPool::require_files(std::span<const std::filesystem::path> files) {
  std::size_t awaited = 0;
  for (const std::filesystem::path& file : files) {
    for (int rank = 1; rank < session_.size(); ++rank) {
      session_.send(rank, tag::file, std::filesystem::absolute(file).string());
      ++awaited;
    }
  }
  std::vector<PoolEvent> none;
  for (Backoff backoff; awaited != 0; backoff.wait(-1)) {
    while (const auto message = session_.receive()) {
      if (message->tag == tag::failed) take(*message, none);
      --awaited;
    }
  }
}

void MpiPool::start(std::size_t worker) {
  workers_[worker].units.clear();
  session_.send(static_cast<int>(worker + 1), tag::start, with_life(++workers_[worker].life, {}));
}

void MpiPool::hand_out(std::size_t worker, std::span<const Unit> units) {
  std::string lines;
  for (const Unit& unit : units) {
    workers_[worker].units.push_back(unit.id);
    lines += unit_line(unit) + '\n';
  }
  session_.send(static_cast<int>(worker + 1), tag::units, with_life(workers_[worker].life, lines));
}

void MpiPool::stop(std::size_t worker) {
  session_.send(static_cast<int>(worker + 1), tag::stop, with_life(workers_[worker].life++, {}));
}

std::vector<PoolEvent> MpiPool::wait(Clock::time_point until, int wake) {
  Backoff backoff;
  std::vector<PoolEvent> events;
  do {
    while (const auto message = session_.receive()) take(*message, events);
  } while (events.empty() && Clock::now() < until && !backoff.wait(wake));
  return events;
}

void MpiPool::take(const MpiSession::Message& message, std::vector<PoolEvent>& events) {
  const std::string rank = "rank " + std::to_string(message.rank) + ": ";
  if (message.tag == tag::failed) throw InputError(rank + message.bytes);
  const std::size_t index = static_cast<std::size_t>(message.rank) - 1;
  Worker& worker = workers_[index];
  const Told told = told_in(message.bytes);
  if (told.life != worker.life) return;  // of one that was stopped
  PoolEvent event{.worker = index};
  if (message.tag == tag::answer) {
    std::optional<AnsweredUnit> answered = parse_answer(told.text);
    if (!answered || worker.units.empty() || answered->id != worker.units.front()) {
      throw InputError(rank + "is no answer: " + told.text.substr(0, 80));
    }
    worker.units.pop_front();
    event.kind = PoolEvent::Kind::answered;
    event.outcome = std::move(answered->outcome);
  } else if (message.tag == tag::lost) {
    event.kind = PoolEvent::Kind::lost;
    event.how = told.text;
  }
  events.push_back(std::move(event));
}

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

void require_readable(const std::string& file) {
  if (std::ifstream(file).good()) return;
  throw InputError(file + ": cannot be read on " + host_name() +
                   ": put it where all machines see it, under the same path");
}

/// The one worker of a rank, and what it owes the coordinator.
class Rank {
 public:
  Rank(MpiSession& session, const std::vector<std::string>& command)
      : session_(session), pool_(command, 1) {}

  void serve() {
    Backoff backoff;
    for (bool is_wanted = true; is_wanted;) {
      bool has_heard = false;
      while (const auto message = session_.receive()) {
        has_heard = true;
        is_wanted = is_wanted && obey(*message);
      }
      // A worker at a unit is waited for, with a look at messages in between; nobody else hurries.
      constexpr std::chrono::milliseconds kLook(5);
      const auto until = Pool::Clock::now() + (is_at_work_ ? kLook : std::chrono::milliseconds(0));
      for (const PoolEvent& event : pool_.wait(until, -1)) {
        has_heard = true;
        tell(event);
      }
      if (has_heard) backoff = {};
      if (is_wanted && !is_at_work_) backoff.wait(-1);
    }
  }

 private:
  /// False when it is to go home.
  bool obey(const MpiSession::Message& message) {
    if (message.tag == tag::go_home) return false;
    if (message.tag == tag::file) {
      require_readable(message.bytes);
      session_.send(0, tag::seen, {});
      return true;
    }
    const Told told = told_in(message.bytes);
    if (message.tag == tag::start) {
      life_ = told.life;
      pool_.start(0);
      is_running_ = true;
      is_at_work_ = true;  // at its start
    } else if (message.tag == tag::units) {
      // Those that were on their way when the worker ended are not its successor's.
      if (is_running_) take_units(told.text);
    } else {
      pool_.stop(0);
      forget_units();
    }
    return true;
  }

  void take_units(const std::string& lines) {
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) units_.push_back(parse_unit(line));
    if (!is_at_work_) begin_next();
  }

  void begin_next() {
    is_at_work_ = !units_.empty();
    if (is_at_work_) pool_.hand_out(0, {&units_.front(), 1});
  }

  void forget_units() {
    units_.clear();
    is_running_ = false;
    is_at_work_ = false;
  }

  void tell(const PoolEvent& event) {
    switch (event.kind) {
      case PoolEvent::Kind::ready:
        is_at_work_ = false;
        return session_.send(0, tag::ready, with_life(life_, {}));
      case PoolEvent::Kind::answered: {
        const std::string id = units_.front().id;
        units_.pop_front();
        begin_next();  // first: it works while its answer is told
        return session_.send(0, tag::answer, with_life(life_, answer_line(id, event.outcome)));
      }
      case PoolEvent::Kind::lost:
        forget_units();
        return session_.send(0, tag::lost, with_life(life_, event.how));
    }
  }

  MpiSession& session_;
  ProcessPool pool_;
  std::uint64_t life_ = 0;
  std::deque<Unit> units_;   ///< that are to be done; the worker is at the first
  bool is_running_ = false;  ///< the worker
  bool is_at_work_ = false;  ///< or at its start
};

}  // namespace

void serve_rank(MpiSession& session, const std::vector<std::string>& command) {
  try {
    Rank(session, command).serve();
  } catch (const Error& error) {
    session.send(0, tag::failed, error.what());
    // The first rank ends with this message, and sends all home.
    Backoff backoff;
    for (auto message = session.receive(); !message || message->tag != tag::go_home;
         message = session.receive()) {
      backoff.wait(-1);
    }
  }
}

}  // namespace nbvopt::experiment
