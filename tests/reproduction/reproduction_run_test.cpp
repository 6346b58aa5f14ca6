#include "reproduction/reproduction_run.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "core/text_file.hpp"
#include "experiment/process_pool.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/room_worlds.hpp"
#include "reproduction/text.hpp"
#include "reproduction/unit_runner.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;
const std::size_t kPlaneUnits = 1 + episode_settings().size();  // a drive, and what runs on it
const std::size_t kUnits = kPlaneUnits + 2 * spatial_tests().size();
using Deeds = std::vector<std::string>;

class ReproductionRun : public testing::Test {
 protected:
  ReproductionRun() { write_room_worlds(folder.path() / "worlds"); }

  /// One start in the apartment: kUnits of them.
  ExperimentOptions options() const {
    ExperimentOptions options;
    options.worlds_folder = folder.path() / "worlds";
    options.folder.root = folder.path() / "out";
    options.environments = {"apartment"};
    options.starts = 1;
    return options;
  }

  static std::vector<Unit> units_of(const ExperimentOptions& options) {
    std::vector<Unit> units = experiment_units(options);
    read_worlds(units);
    return units;
  }

  /// Runs it on workers that simulate nothing, and gives what they were asked.
  std::vector<std::string> run(const ExperimentOptions& options, const Deeds& deeds = {},
                               std::size_t workers = 2) {
    const std::string calls = folder / "calls";
    fs::remove(calls);
    std::vector<std::string> command{NBVOPT_ODD_SIMULATOR, calls};
    command.insert(command.end(), deeds.begin(), deeds.end());
    failures.clear();
    experiment::ProcessPool pool(command, workers);
    result = run_reproduction(units_of(options), options.folder, pool, [this](const Json& record) {
      if (record.contains("failure")) {
        failures[record.at("name")] = record.at("failure");
      }
      on_record(record);
    });
    std::vector<std::string> asked;
    std::ifstream in(calls);
    for (std::string line; std::getline(in, line);) asked.push_back(line);
    return asked;
  }

  static ReproductionTable table(const ExperimentOptions& options) {
    const std::vector<Unit> units = units_of(options);
    return make_table(units, read_results(units, options.folder));
  }
  static std::string text(const ExperimentOptions& options) {
    return to_text(to_json(table(options)));
  }

  fs::path records() const { return options().folder.records(); }
  std::string trajectory() const { return folder / "out/units/apartment-1-trajectory.csv"; }

  const TemporaryFolder folder;
  experiment::RunResult result;
  std::map<std::string, std::string> failures;  ///< by unit
  std::function<void(const Json&)> on_record = [](const Json&) {};
};

TEST_F(ReproductionRun, RunsEveryUnitOnce) {
  const auto asked = run(options(), {}, 1);
  EXPECT_EQ(asked.size(), kUnits);
  EXPECT_EQ(asked.front(), "drive") << "all the others need it";
  EXPECT_EQ(result.finished, kUnits);
  EXPECT_EQ(result.failed, 0U);
  EXPECT_THAT(table(options()).missing, ElementsAre());
  EXPECT_THAT(run(options()), ElementsAre());
}

TEST_F(ReproductionRun, GivesTheSameTableForAnyNumberOfWorkers) {
  ExperimentOptions one = options();
  one.environments = {"apartment", "willowgarage"};
  one.starts = 2;
  ExperimentOptions three = one;
  three.folder.root = folder.path() / "out-3";
  EXPECT_EQ(run(one, {}, 1).size(), 4 * kUnits);
  EXPECT_EQ(run(three, {}, 3).size(), 4 * kUnits);
  EXPECT_EQ(text(one), text(three));
}

TEST_F(ReproductionRun, GoesOnAfterATornLine) {
  run(options());
  const std::string whole = text(options());
  fs::resize_file(records(), fs::file_size(records()) - 20);
  EXPECT_NE(text(options()), whole);
  EXPECT_EQ(run(options()).size(), 1U);
  EXPECT_EQ(text(options()), whole);
}

TEST_F(ReproductionRun, AnotherExperimentRunsAgain) {
  run(options());
  ExperimentOptions other = options();
  other.duration_max_s = 30.0;
  EXPECT_EQ(run(other).size(), kUnits) << "the drive, and so what is run on it";
  other.seed = 7;
  EXPECT_EQ(run(other).size(), kUnits);
  EXPECT_EQ(run(other).size(), 0U);
  EXPECT_EQ(run(options()).size(), kUnits) << "its trajectory was overwritten";
}

TEST_F(ReproductionRun, AChangedWorldRunsAgain) {
  run(options());
  write_room_worlds(folder.path() / "worlds", 3.25);
  EXPECT_EQ(run(options()).size(), kUnits);
  EXPECT_EQ(run(options()).size(), 0U);
}

TEST_F(ReproductionRun, AMovedWorldDoesNot) {
  run(options());
  fs::rename(folder.path() / "worlds", folder.path() / "elsewhere");
  ExperimentOptions moved = options();
  moved.worlds_folder = folder.path() / "elsewhere";
  EXPECT_EQ(run(moved).size(), 0U);
}

TEST_F(ReproductionRun, AnotherVersionRunsAgain) {
  const std::vector<Unit> units = units_of(options());
  const auto now = fingerprints(units);
  const auto next = fingerprints(units, std::string(version()) + ".1");
  ASSERT_EQ(now.size(), next.size());
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_NE(now[i], next[i]) << units[i].name;
  EXPECT_EQ(std::set(now.begin(), now.end()).size(), now.size()) << "two units are told apart";
}

TEST_F(ReproductionRun, ALostOrChangedTrajectoryIsMadeAgainWithItsEpisodes) {
  run(options());
  fs::remove(trajectory());
  EXPECT_EQ(run(options()).size(), kPlaneUnits);
  std::ofstream(trajectory(), std::ios::app) << "9999,0,0,0,0\n";
  EXPECT_EQ(run(options()).size(), kPlaneUnits);
}

TEST_F(ReproductionRun, AFailedUnitLeavesAHoleAndIsTriedAgain) {
  EXPECT_EQ(run(options(), {"auto-0.5", "throw"}).size(), kUnits);
  EXPECT_EQ(result.failed, 1U);
  EXPECT_EQ(failures, (std::map<std::string, std::string>{{"apartment-1-auto-0.5", "no room"}}));
  EXPECT_THAT(table(options()).missing, ElementsAre("apartment-1-auto-0.5"));
  EXPECT_THAT(run(options()), ElementsAre("auto-0.5"));
  EXPECT_THAT(table(options()).missing, ElementsAre());
}

TEST_F(ReproductionRun, AUnitThatEndsItsWorkerCostsItself) {
  const auto asked = run(options(), {"auto-0.5", "abort"});
  EXPECT_EQ(std::ranges::count(asked, "auto-0.5"), 2);
  EXPECT_EQ(asked.size(), kUnits + 1);
  EXPECT_EQ(failures["apartment-1-auto-0.5"], "its worker ended, twice: Aborted");
  EXPECT_THAT(table(options()).missing, ElementsAre("apartment-1-auto-0.5"));
}

TEST_F(ReproductionRun, AUnitWhoseWorkerWasKilledIsRunAgain) {
  for (const char* unit : {"drive", "grid-1"}) {
    fs::remove_all(options().folder.root);
    const auto asked = run(options(), {unit, "die-once"});
    EXPECT_EQ(std::ranges::count(asked, unit), 2);
    EXPECT_EQ(result.failed, 0U);
    EXPECT_THAT(table(options()).missing, ElementsAre());
  }
}

TEST_F(ReproductionRun, WithoutItsDriveNoEpisodeIsRun) {
  EXPECT_THAT(run(options(), {"drive", "throw", "drive-3d", "throw"}, 1),
              ElementsAre("drive", "drive-3d", "drive-3d-tekniker", "drive-3d-after-2d",
                          "static-0.5", "static-0.5", "drive-nbv", "auto-expected-0.5"));
  EXPECT_EQ(result.failed, 2U);
  EXPECT_EQ(table(options()).missing.size(), kUnits - 6);
}

TEST_F(ReproductionRun, AStopLosesNothing) {
  const auto asked = run(options(), {"auto-0.2", "interrupt-once"}, 1);
  EXPECT_EQ(result.stopped_by, SIGINT);
  EXPECT_THAT(asked, Contains("auto-0.2"));
  EXPECT_THAT(asked, Not(Contains("auto-1")));
  EXPECT_EQ(result.finished, asked.size()) << "what was at work is kept";
  const auto rest = run(options());
  EXPECT_EQ(rest.size() + asked.size(), kUnits);
  EXPECT_THAT(table(options()).missing, ElementsAre());
}

TEST_F(ReproductionRun, RefusesAFolderInUse) {
  std::string message;
  on_record = [&](const Json&) {
    if (message.empty()) {
      message = message_of<InputError>([&] {
        experiment::ProcessPool none({"/bin/false"}, 1);
        run_reproduction(units_of(options()), options().folder, none, [](const Json&) {});
      });
    }
  };
  run(options());
  EXPECT_THAT(message, HasSubstr("another run writes this reproduction"));
}

TEST_F(ReproductionRun, NamesADamagedRecord) {
  run(options());
  std::ofstream(records(), std::ios::app) << R"({"schema":2,"unit":"x"})" << '\n';
  EXPECT_THAT(message_of<InputError>([&] { run(options()); }),
              testing::AllOf(HasSubstr("records.jsonl: line " + std::to_string(kUnits + 1)),
                             HasSubstr("schema 2")));
}

TEST_F(ReproductionRun, AWorkerNoticesAWorldThatHasChanged) {
  const std::vector<Unit> units = units_of(options());
  write_room_worlds(folder.path() / "worlds", 3.5);
  UnitRunner runner;
  EXPECT_THAT(message_of<InputError>([&] { runner.run(units[0].simulation); }),
              HasSubstr("has changed since the reproduction began"));
}

TEST(Simulation, IsTheSameAfterItsWay) {
  ExperimentOptions options;
  const TemporaryFolder folder;
  write_room_worlds(folder.path());
  options.worlds_folder = folder.path();
  options.world = {.model_paths = {"here", "there"}, .cache_folder = "cache"};
  for (Unit& unit : experiment_units(options)) {
    unit.simulation.world.digest = "digest";
    const Json json = to_json(unit.simulation);
    EXPECT_EQ(to_json(simulation_unit_of(json)), json);
  }
  EXPECT_THAT(message_of<InputError>([&] {
                simulation_unit_of({{"world", 3}});
              }),
              HasSubstr("unit: "));
}

}  // namespace
}  // namespace nbvopt::test
