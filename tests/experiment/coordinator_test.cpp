// The coordinator on workers that do as a test says.
#include "experiment/coordinator.hpp"

#include <gmock/gmock.h>
#include <poll.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "support/temporary_folder.hpp"

namespace nbvopt::experiment {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

/// Units that are told by their index; some wait for another.
class NumberedWork final : public Work {
 public:
  std::string id(std::size_t index) override { return std::to_string(index); }

  Unit unit(std::size_t index) override { return {id(index), Json::object()}; }

  Json record(std::size_t index, const Outcome& outcome) override {
    return {{"unit", index}, {"failure", outcome.failure}};
  }

  std::optional<std::size_t> predecessor(std::size_t index) const override {
    const auto found = predecessors.find(index);
    return found == predecessors.end() ? std::nullopt : std::optional(found->second);
  }

  std::map<std::size_t, std::size_t> predecessors;
};

/// Workers that answer at once, one after the other, unless told otherwise of a unit.
class MadePool final : public Pool {
 public:
  explicit MadePool(std::size_t workers, std::size_t most_units = 1)
      : most_units_(most_units), units_(workers) {}

  std::size_t size() const override { return units_.size(); }
  std::size_t most_units_a_worker() const override { return most_units_; }

  void start(std::size_t worker) override {
    ++starts;
    events_.push_back({.worker = worker, .kind = PoolEvent::Kind::ready});
  }

  void hand_out(std::size_t worker, std::span<const Unit> units) override {
    const bool was_idle = units_[worker].empty();
    for (const Unit& unit : units) {
      units_[worker].push_back(unit.id);
      handed_out.push_back(unit.id);
    }
    EXPECT_LE(units_[worker].size(), most_units_);
    most_held = std::max(most_held, units_[worker].size());
    ++messages;
    if (was_idle) begin(worker);
  }

  void stop(std::size_t worker) override {
    EXPECT_FALSE(units_[worker].empty());
    units_[worker].clear();
    ++stops;
  }

  std::vector<PoolEvent> wait(Clock::time_point until, int wake) override {
    if (events_.empty()) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
      pollfd woken{wake, POLLIN, 0};
      ::poll(&woken, 1, static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 10'000)));
      return {};
    }
    PoolEvent event = std::move(events_.front());
    events_.erase(events_.begin());
    std::deque<std::string>& units = units_[event.worker];
    if (event.kind == PoolEvent::Kind::lost) units.clear();
    if (event.kind == PoolEvent::Kind::answered) {
      units.pop_front();
      if (!units.empty()) begin(event.worker);
    }
    return {std::move(event)};
  }

  double busy_ms = 2.0;  ///< that a unit takes
  std::set<std::string> hanging;
  std::set<std::string> failing;
  std::map<std::string, int> deadly;  ///< how often a unit ends its worker
  std::vector<std::string> handed_out;
  std::size_t messages = 0;   ///< that units were handed out by
  std::size_t most_held = 0;  ///< units of a worker at a time
  int starts = 0;
  int stops = 0;

 private:
  /// The worker is at its first unit.
  void begin(std::size_t worker) {
    const std::string& unit = units_[worker].front();
    if (hanging.contains(unit)) return;
    PoolEvent event{.worker = worker, .kind = PoolEvent::Kind::answered};
    event.outcome.answer = Json::object();
    event.outcome.busy_ms = busy_ms;
    if (failing.contains(unit)) event.outcome = {.answer = Json(), .failure = "tired"};
    if (deadly.contains(unit) && deadly[unit]-- > 0) {
      event = {.worker = worker, .kind = PoolEvent::Kind::lost, .how = "Killed"};
    }
    events_.push_back(std::move(event));
  }

  std::size_t most_units_;
  std::vector<std::deque<std::string>> units_;
  std::vector<PoolEvent> events_;
};

class Coordination : public testing::Test {
 protected:
  RunResult run(MadePool& pool, const std::vector<std::size_t>& to_do, double timeout_s = 60.0) {
    RecordFile file(folder / "records.jsonl");
    return run_units(
        work, to_do, timeout_s, pool, file, [this](const Json& record) { on_record(record); },
        [this](std::size_t units) { waited_for.push_back(units); });
  }

  /// The units that have a record, in its order, and why they failed.
  std::vector<std::pair<std::size_t, std::string>> records() const {
    std::vector<std::pair<std::size_t, std::string>> found;
    for_each_record(folder / "records.jsonl", [&](const Json& record) {
      found.emplace_back(record.at("unit").get<std::size_t>(),
                         record.at("failure").get<std::string>());
    });
    return found;
  }

  const test::TemporaryFolder folder;
  NumberedWork work;
  std::function<void(const Json&)> on_record = [](const Json&) {};
  std::vector<std::size_t> waited_for;  ///< units, at each stop
};

TEST_F(Coordination, RunsWhatIsToDoInItsOrder) {
  MadePool pool(1);
  const RunResult result = run(pool, {1, 4, 5});
  EXPECT_THAT(pool.handed_out, ElementsAre("1", "4", "5"));
  EXPECT_EQ(result.finished, 3U);
  EXPECT_EQ(result.failed, 0U);
  EXPECT_EQ(result.busy_ms, 6.0);
  EXPECT_EQ(result.stopped_by, std::nullopt);
  EXPECT_EQ(records().size(), 3U);
}

TEST_F(Coordination, StartsNoMoreWorkersThanUnits) {
  MadePool pool(8);
  run(pool, {0, 1});
  EXPECT_EQ(pool.starts, 2);
  MadePool idle(2);
  EXPECT_EQ(run(idle, {}).finished, 0U);
  EXPECT_EQ(idle.starts, 0);
}

TEST_F(Coordination, AUnitWaitsForAnothersRecord) {
  work.predecessors = {{0, 2}, {1, 2}};
  MadePool pool(2);
  on_record = [&](const Json& record) {
    if (record.at("unit") == 2) {
      EXPECT_THAT(pool.handed_out, ElementsAre("2", "3")) << "before the record of 2";
    }
  };
  run(pool, {0, 1, 2, 3});
  EXPECT_THAT(pool.handed_out, UnorderedElementsAre("2", "3", "0", "1"));
}

TEST_F(Coordination, WhatIsNotToDoIsNotWaitedFor) {
  work.predecessors = {{3, 0}};
  MadePool pool(1);
  EXPECT_EQ(run(pool, {3}).finished, 1U);
}

TEST_F(Coordination, WhatWaitsForAFailedUnitIsNotRun) {
  work.predecessors = {{1, 0}, {2, 1}, {4, 3}};
  MadePool pool(2);
  pool.failing = {"0"};
  const RunResult result = run(pool, {0, 1, 2, 3, 4});
  EXPECT_THAT(pool.handed_out, UnorderedElementsAre("0", "3", "4"));
  EXPECT_EQ(result.finished, 3U);
  EXPECT_EQ(result.failed, 1U);
}

TEST_F(Coordination, WorkersThatWereLostComeBackForWhatHasWaited) {
  work.predecessors = {{2, 0}, {3, 0}};
  MadePool pool(2);
  pool.deadly = {{"1", 2}};
  const RunResult result = run(pool, {0, 1, 2, 3});
  EXPECT_EQ(result.finished, 4U);
  EXPECT_THAT(records(),
              Contains(std::pair<std::size_t, std::string>(1, "its worker ended, twice: Killed")));
  EXPECT_THAT(pool.handed_out, UnorderedElementsAre("0", "1", "1", "2", "3"));
}

TEST_F(Coordination, AUnitWhoseWorkerIsLostOnceIsRunAgain) {
  MadePool pool(1);
  pool.deadly = {{"0", 1}};
  const RunResult result = run(pool, {0});
  EXPECT_EQ(result.finished, 1U);
  EXPECT_EQ(result.failed, 0U);
  EXPECT_EQ(pool.starts, 2);
}

TEST_F(Coordination, AUnitThatHangsIsStoppedInTime) {
  MadePool pool(1);
  pool.hanging = {"0"};
  const RunResult result = run(pool, {0, 1}, 0.05);
  EXPECT_EQ(pool.stops, 1);
  EXPECT_EQ(pool.starts, 2);
  EXPECT_EQ(result.failed, 1U);
  EXPECT_THAT(records(),
              ElementsAre(std::pair(0, "stopped by the watchdog after 0.05 s"), std::pair(1, "")));
}

TEST_F(Coordination, AStopWaitsForWhatIsAtWork) {
  MadePool pool(2);
  pool.hanging = {"1"};
  on_record = [](const Json& record) {
    if (record.at("unit") == 2) std::raise(SIGINT);  // held back by the coordinator
  };
  const RunResult result = run(pool, {0, 1, 2, 3, 4, 5}, 0.2);
  EXPECT_EQ(result.stopped_by, SIGINT);
  EXPECT_THAT(records(), Contains(std::pair<std::size_t, std::string>(
                             1, "stopped by the watchdog after 0.2 s")));
  EXPECT_THAT(pool.handed_out, Not(Contains("5")));
  EXPECT_THAT(waited_for, ElementsAre(2)) << "one that hangs, and the one after that which ended";
}

TEST_F(Coordination, ASecondStopDropsWhatIsAtWork) {
  MadePool pool(1);
  pool.hanging = {"1"};
  int signals = 0;
  on_record = [&signals](const Json&) {
    ++signals;
    std::raise(SIGINT);
    std::raise(SIGTERM);
  };
  const RunResult result = run(pool, {0, 1, 2});
  EXPECT_EQ(signals, 1);
  EXPECT_EQ(result.stopped_by, SIGINT);
  EXPECT_LT(result.wall_ms, 10'000.0) << "unit 1 would hang for a minute";
  EXPECT_THAT(records(), ElementsAre(std::pair(0, "")));
}

TEST_F(Coordination, OneThatIsLostAfterAStopIsLeftToTheNextRun) {
  MadePool pool(1);
  pool.deadly = {{"1", 5}};
  on_record = [](const Json&) { std::raise(SIGTERM); };
  const RunResult result = run(pool, {0, 1});
  EXPECT_EQ(result.stopped_by, SIGTERM);
  EXPECT_EQ(result.finished, 1U);
  EXPECT_EQ(result.failed, 0U);
  EXPECT_EQ(pool.starts, 1);
}

/// 0 and those after it.
std::vector<std::size_t> first(std::size_t count) {
  std::vector<std::size_t> units(count);
  std::iota(units.begin(), units.end(), std::size_t{0});
  return units;
}

TEST_F(Coordination, ShortUnitsGoSeveralAtATime) {
  MadePool pool(2, 64);
  EXPECT_EQ(run(pool, first(1000)).finished, 1000U);
  EXPECT_EQ(pool.most_held, 50U) << "a tenth of a second's";
  EXPECT_LT(pool.messages, 100U);
  EXPECT_EQ(pool.handed_out.size(), 1000U);
}

TEST_F(Coordination, LongUnitsGoOneByOne) {
  MadePool pool(2, 64);
  pool.busy_ms = 1000.0;
  run(pool, first(100));
  EXPECT_EQ(pool.most_held, 1U);
}

TEST_F(Coordination, ALostWorkersOtherUnitsAreOthers) {
  MadePool pool(2, 64);
  pool.deadly = {{"500", 2}};
  const RunResult result = run(pool, first(1000));
  EXPECT_EQ(result.finished, 1000U);
  EXPECT_EQ(result.failed, 1U);
  EXPECT_EQ(records().size(), 1000U);
  EXPECT_THAT(records(), Contains(std::pair<std::size_t, std::string>(
                             500, "its worker ended, twice: Killed")));
}

TEST_F(Coordination, AHangingUnitCostsNoneThatWaitsBehindIt) {
  MadePool pool(2, 64);
  pool.hanging = {"500"};
  const RunResult result = run(pool, first(1000), 0.2);
  EXPECT_EQ(result.finished, 1000U);
  EXPECT_EQ(result.failed, 1U);
  EXPECT_EQ(pool.stops, 1);
  EXPECT_THAT(records(), Contains(std::pair<std::size_t, std::string>(
                             500, "stopped by the watchdog after 0.2 s")));
}

}  // namespace
}  // namespace nbvopt::experiment
