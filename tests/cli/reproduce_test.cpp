// `nbvopt reproduce`, with a script in the place of `nbvopt simulate`.
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

#include "cli/command_line.hpp"
#include "cli/reproduction.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string bytes_of(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

class Reproduce : public testing::Test {
 protected:
  Reproduce() {
    for (const ExperimentEnvironment& environment : experiment_environments()) {
      const fs::path world = worlds() / environment.world_file;
      fs::create_directories(world.parent_path());
      std::ofstream(world) << "<sdf/>";
    }
  }

  fs::path worlds() const { return folder.path() / "worlds"; }

  /// A program that notes its summary's name and writes what simulate would, with figures of the
  /// mode and t. `first` is shell code that it runs before: $name is the unit's.
  std::string fake_simulate(const std::string& first = {}) {
    const std::string path = folder.write(
        "simulate-" + std::to_string(++programs_),
        "#!/bin/sh\n"
        "while [ $# -gt 0 ]; do case $1 in\n"
        "  --summary) summary=$2 ;; --trajectory-out) trajectory=$2 ;;\n"
        "  --mode) mode=$2 ;; --motion-time) t=$2 ;;\n"
        "esac; shift; done\n"
        "name=$(basename \"$summary\" .json)\n" +
            first + "\necho \"$name\" >> '" + folder / "calls" +
            "'\n"
            "if [ -n \"$trajectory\" ]; then\n"
            "  echo time_s,x_m,y_m,z_m,yaw_rad > \"$trajectory\"\n"
            "  echo '{\"status\": \"complete\", \"duration_s\": 100, \"length_m\": 9}' > "
            "\"$summary\"\n"
            "  exit\n"
            "fi\n"
            "case $mode in static) info=1000 ;; *) info=1${#mode}00 ;; esac\n"
            "sums='\"sum_x\": 3, \"sum_y\": 4, \"sum_xx\": 5, \"sum_yy\": 10, \"sum_xy\": 7'\n"
            "echo \"{\\\"duration_s\\\": 100, \\\"voxels\\\": 2000, \\\"information\\\": $info,\n"
            "\\\"voxels_as_paper_counts\\\": 3000, \\\"information_as_paper_counts\\\": 1500,\n"
            "\\\"prediction\\\": {\\\"steps\\\": 2, \\\"pooled\\\": {$sums}}}\" > \"$summary\"\n");
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }

  /// One start in the apartment: 12 units.
  ReproduceOptions options(const std::string& program) const {
    ReproduceOptions options;
    options.experiment.worlds_folder = worlds();
    options.experiment.output_folder = folder.path() / "out";
    options.experiment.environments = {"apartment"};
    options.experiment.starts = 1;
    options.jobs = 2;
    options.program = program;
    return options;
  }

  /// Runs it and gives the names of the units that were run to their end.
  std::vector<std::string> run(const ReproduceOptions& options) {
    fs::remove(folder / "calls");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    is_input_error = false;
    error = message_of<Error>([&] {
      try {
        reproduce(options);
      } catch (const InputError&) {
        is_input_error = true;
        throw;
      }
    });
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    std::vector<std::string> calls;
    std::ifstream in(folder / "calls");
    for (std::string line; std::getline(in, line);) calls.push_back(line);
    return calls;
  }

  std::string unit_file(const std::string& name) const { return folder / ("out/units/" + name); }

  const TemporaryFolder folder;
  std::string error;  ///< what it threw
  bool is_input_error = false;
  std::string out;
  std::string err;

 private:
  int programs_ = 0;
};

TEST_F(Reproduce, RunsEveryUnitAndWritesItsTables) {
  const auto calls = run(options(fake_simulate()));
  EXPECT_EQ(error, "");
  EXPECT_EQ(calls.size(), 12U);
  EXPECT_EQ(calls.front(), "apartment-1-trajectory");
  EXPECT_EQ(out, bytes_of(folder / "out/table.md"));
  EXPECT_THAT(out, HasSubstr("| 2D+auto (t=0.5) | 1 | 2,000 | 0.00% | 1,400 | 400 | 40.00% |"));
  EXPECT_THAT(bytes_of(folder / "out/table.csv"), HasSubstr("apartment (19x11),2D+auto,0.5,1,"));
  EXPECT_THAT(bytes_of(folder / "out/prediction.csv"), HasSubstr("all,2D+auto,0.5,2,3,4,"));
  EXPECT_TRUE(nlohmann::json::parse(bytes_of(folder / "out/table.json"))["missing"].empty());
}

TEST_F(Reproduce, GivesTheSameBytesForAnyNumberOfJobs) {
  ReproduceOptions one = options(fake_simulate());
  one.jobs = 1;
  ReproduceOptions two = one;
  two.jobs = 2;
  two.experiment.output_folder = folder.path() / "out-2";
  for (ReproduceOptions* both : {&one, &two}) {
    both->experiment.environments = {"apartment", "willowgarage"};
    both->experiment.starts = 2;
    EXPECT_EQ(run(*both).size(), 36U);
  }
  for (const std::string name : {"table.md", "table.csv", "prediction.csv", "table.json"}) {
    EXPECT_EQ(bytes_of(folder / ("out/" + name)), bytes_of(folder / ("out-2/" + name))) << name;
    EXPECT_NE(bytes_of(folder / ("out/" + name)), "") << name;
  }
}

TEST_F(Reproduce, GoesOnWhereItWasAndRunsDamagedUnitsAgain) {
  const std::string program = fake_simulate();
  run(options(program));
  const std::string table = bytes_of(folder / "out/table.json");
  EXPECT_TRUE(run(options(program)).empty());
  EXPECT_EQ(bytes_of(folder / "out/table.json"), table);

  fs::resize_file(unit_file("apartment-1-auto-0.5.json"), 30);
  fs::remove(unit_file("apartment-1-grid-1.json"));
  std::ofstream(unit_file("apartment-1-static-0.2.json")) << "{}";
  EXPECT_THAT(run(options(program)),
              testing::UnorderedElementsAre("apartment-1-auto-0.5", "apartment-1-grid-1",
                                            "apartment-1-static-0.2"));
  EXPECT_EQ(bytes_of(folder / "out/table.json"), table);
}

TEST_F(Reproduce, AChangedCommandRunsAgainWhatItChanges) {
  const std::string program = fake_simulate();
  run(options(program));
  ReproduceOptions longer = options(program);
  longer.experiment.duration_max_s = 30.0;
  EXPECT_EQ(run(longer).size(), 12U) << "the trajectory, and so what is run on it";
  longer.experiment.seed = 7;
  EXPECT_EQ(run(longer).size(), 12U);
  EXPECT_TRUE(run(longer).empty());
}

TEST_F(Reproduce, WhatAnotherCommandMadeIsNotTakenForAFailedUnit) {
  run(options(fake_simulate()));
  ReproduceOptions failing = options(fake_simulate("case $name in *-auto-0.5) exit 3 ;; esac"));
  failing.experiment.seed = 7;
  EXPECT_EQ(run(failing).size(), 11U);
  EXPECT_THAT(out, HasSubstr("| 2D+auto (t=0.5) | missing |"));
}

TEST_F(Reproduce, ALostTrajectoryIsMadeAgainWithItsEpisodes) {
  const std::string program = fake_simulate();
  run(options(program));
  fs::remove(unit_file("apartment-1-trajectory.csv"));
  EXPECT_EQ(run(options(program)).size(), 12U);
}

TEST_F(Reproduce, AFailedUnitIsToldAndLeavesAHole) {
  const std::string program =
      fake_simulate("case $name in *-auto-0.5) echo 'nbvopt: no room' >&2; exit 3 ;; esac");
  EXPECT_EQ(run(options(program)).size(), 11U);
  EXPECT_THAT(err, AllOf(HasSubstr("unit apartment-1-auto-0.5 failed: nbvopt: no room"),
                         HasSubstr("apartment-1-auto-0.5.log")));
  EXPECT_THAT(error, HasSubstr("1 of 12 units failed"));
  EXPECT_THAT(out, AllOf(HasSubstr("| 2D+auto (t=0.5) | missing |"),
                         HasSubstr("to their end: apartment-1-auto-0.5.")));
  EXPECT_THAT(run(options(fake_simulate())), testing::ElementsAre("apartment-1-auto-0.5"));
  EXPECT_EQ(error, "");
}

TEST_F(Reproduce, FailsAsTheWorstUnitDid) {
  const auto is_internal = [this](const std::string& first) {
    run(options(fake_simulate(first)));
    return !is_input_error;
  };
  EXPECT_FALSE(is_internal("case $name in *-auto-*) exit 3 ;; esac"));
  EXPECT_TRUE(is_internal("case $name in *-auto-0.2) exit 4 ;; *-auto-*) exit 3 ;; esac"));
  EXPECT_THAT(error, HasSubstr("3 of 12 units failed"));
  EXPECT_TRUE(is_internal("case $name in *-auto-1) exit 0 ;; esac"));
  EXPECT_THAT(err, HasSubstr("unit apartment-1-auto-1 failed: it ended well, but left no whole"));
}

TEST_F(Reproduce, WithoutItsTrajectoryNoEpisodeIsRun) {
  EXPECT_TRUE(run(options(fake_simulate("exit 3"))).empty());
  EXPECT_THAT(error, HasSubstr("1 of 12 units failed"));
  EXPECT_THAT(out, HasSubstr("| 2D+auto (t=0.5) | missing |"));
}

TEST_F(Reproduce, WhenStoppedItKeepsWhatIsDone) {
  ReproduceOptions stopped =
      options(fake_simulate("case $name in *-auto-0.5) kill -TERM $PPID; exec sleep 60 ;; esac"));
  stopped.jobs = 1;
  EXPECT_EXIT(reproduce(stopped), testing::KilledBySignal(SIGTERM), "the same command goes on");
  EXPECT_FALSE(fs::exists(folder / "out/table.md"));
  EXPECT_TRUE(fs::exists(unit_file("apartment-1-static-0.5.json")));
  const auto calls = run(options(fake_simulate()));
  EXPECT_THAT(calls, testing::Contains("apartment-1-auto-0.5"));
  EXPECT_THAT(calls, testing::Not(testing::Contains("apartment-1-static-0.5")));
}

TEST_F(Reproduce, DryRunPrintsTheCommandsAndRunsNone) {
  ReproduceOptions dry = options(fake_simulate());
  dry.dry_run = true;
  dry.experiment.duration_max_s = 60.0;
  EXPECT_TRUE(run(dry).empty());
  EXPECT_EQ(std::ranges::count(out, '\n'), 13);
  EXPECT_THAT(out, testing::StartsWith("nbvopt simulate "));
  EXPECT_THAT(out, HasSubstr("--explore-only --trajectory-out "));
  EXPECT_THAT(out, HasSubstr("--lidar-range 4 --duration-max 60 --seed 1 --summary "));
  EXPECT_THAT(out, HasSubstr("--mode grid-3 --motion-time 0.5 --seed 1 --summary "));
  EXPECT_THAT(out, testing::EndsWith("# 12 commands, 0 of them done\n"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Reproduce, PlansThePapersExperimentByDefault) {
  ExperimentOptions all;
  all.worlds_folder = worlds();
  const auto units = experiment_units(all);
  EXPECT_EQ(units.size(), 13U * 12U) << "three starts each, one in willowgarage";
  for (const Unit& unit : units) EXPECT_EQ(unit.name.find(' '), std::string::npos);
}

TEST_F(Reproduce, CommandsAreQuotedForAShell) {
  ExperimentOptions odd = options("").experiment;
  odd.output_folder = "it's here";
  EXPECT_THAT(command_line(experiment_units(odd)[0]),
              HasSubstr("'it'\\''s here/units/apartment-1-trajectory.json'"));
}

TEST_F(Reproduce, RefusesAMissingWorldBeforeAnythingRuns) {
  fs::remove_all(worlds() / "cafe");
  ReproduceOptions all = options(fake_simulate());
  all.experiment.environments = {};
  EXPECT_TRUE(run(all).empty());
  EXPECT_THAT(error, AllOf(HasSubstr("cafe_static_closed.world"), HasSubstr("--environments")));
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_EQ(run(options(fake_simulate())).size(), 12U) << "the apartment is there";
}

TEST_F(Reproduce, RefusesWrongCommandLines) {
  const auto refuse = [&](const std::vector<std::string>& more, int code,
                          const std::string& named) {
    std::vector<std::string> arguments{"reproduce", "--worlds", worlds().string(), "--out",
                                       folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refusal(nbvopt_run(arguments), code, named);
  };
  refuse({"--environments", "apartment,moon"}, 2, "'moon' is none of simple_house, apartment");
  refuse({"--starts", "0"}, 3, "--starts is 0");
  refuse({"--jobs", "many"}, 2, "--jobs: 'many'");
  refuse({"--duration-max", "inf"}, 3, "--duration-max is inf");
  expect_refusal(nbvopt_run({"reproduce", "--out", "x"}), 2, "--worlds");
  expect_refusal(nbvopt_run({"reproduce", "--worlds", worlds().string(), "--out", "/dev/null/x"}),
                 3, "/dev/null/x");
}

TEST_F(Reproduce, ExplainsItself) {
  const ProcessResult help = nbvopt_run({"reproduce", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("Usage: nbvopt reproduce"), HasSubstr("--dry-run")));
}

}  // namespace
}  // namespace nbvopt::test
