// `nbvopt reproduce` as its users run it, in worlds that are seen in seconds.
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "cli/command_line.hpp"
#include "core/text_file.hpp"
#include "reproduction/room_worlds.hpp"
#include "support/background_process.hpp"
#include "support/wait_until.hpp"

namespace nbvopt::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using Arguments = std::vector<std::string>;

class Reproduce : public testing::Test {
 protected:
  Reproduce() {
    write_room_worlds(folder.path() / "worlds");
    ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
  }

  /// Two seconds from the apartment's first start: 26 units.
  Arguments arguments(const std::string& out, const Arguments& more = {}) const {
    Arguments all{"reproduce",      "--worlds",   folder / "worlds",
                  "--out",          folder / out, "--environments",
                  "apartment",      "--starts",   "1",
                  "--duration-max", "2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::string file(const std::string& name) const { return read_text_file(folder / name); }

  /// The records by their unit's name, times left out.
  std::map<std::string, json> records(const std::string& out) const {
    std::map<std::string, json> result;
    for (json& record : lines_of(folder / out + "/records.jsonl")) {
      record.erase("times_ms");
      const std::string name = record.at("name");
      EXPECT_FALSE(result.contains(name)) << "recorded twice";
      result[name] = record;
    }
    return result;
  }

  std::size_t records_so_far(const std::string& out) const {
    std::ifstream in(folder / out + "/records.jsonl");
    return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
  }

  const TemporaryFolder folder;
};

TEST_F(Reproduce, RunsTheExperimentAndWritesItsTables) {
  const ProcessResult result = nbvopt_run(arguments("out"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, file("out/table.md"));
  EXPECT_THAT(result.out, HasSubstr("|  | 2D+auto (t=0.5) | 1 | "));
  EXPECT_THAT(result.out,
              HasSubstr("for lack of time: apartment-1-trajectory, apartment-1-nbv-trajectory."));
  EXPECT_THAT(file("out/table.csv"), HasSubstr("apartment (19x11),2D+auto,0.5,1,"));
  EXPECT_THAT(file("out/prediction.csv"), HasSubstr("all,2D+auto,0.5,"));
  EXPECT_TRUE(json::parse(file("out/table.json"))["missing"].empty());
  EXPECT_EQ(records("out").size(), 26U);

  const std::string before = file("out/records.jsonl");
  EXPECT_EQ(nbvopt_run(arguments("out")).out, result.out);
  EXPECT_EQ(file("out/records.jsonl"), before) << "what is done is not run again";
  const ProcessResult dry = nbvopt_run(arguments("out", {"--dry-run"}));
  EXPECT_THAT(dry.out, testing::EndsWith("# 26 commands, 26 of them done\n"));
}

TEST_F(Reproduce, DryRunPrintsTheCommandsAndRunsNone) {
  const ProcessResult dry = nbvopt_run(arguments("out", {"--dry-run"}));
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_EQ(std::ranges::count(dry.out, '\n'), 27);
  EXPECT_THAT(dry.out, testing::StartsWith("nbvopt simulate "));
  EXPECT_THAT(dry.out, HasSubstr(" --start 0,0,0 --explore-only --trajectory-out "));
  EXPECT_THAT(dry.out,
              HasSubstr("--lidar-range 4 --duration-max 2 --explore 3d --seed 1 --summary "));
  EXPECT_THAT(dry.out,
              HasSubstr("--mode grid-3 --gain positive --motion-time 0.5 --seed 1 --summary "));
  EXPECT_THAT(dry.out, testing::EndsWith("# 26 commands, 0 of them done\n"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

/// The words of a command line without quotes.
Arguments words(const std::string& line) {
  Arguments all;
  std::istringstream in(line);
  for (std::string word; in >> word;) all.push_back(word);
  return all;
}

TEST_F(Reproduce, ItsCommandsDoWhatItDoes) {
  ASSERT_EQ(nbvopt_run(arguments("out")).exit_code, 0);
  const std::map<std::string, json> made = records("out");
  const std::string trajectory = file("out/units/apartment-1-trajectory.csv");
  std::istringstream dry(nbvopt_run(arguments("out", {"--dry-run"})).out);
  std::size_t compared = 0;
  for (std::string line; std::getline(dry, line) && line[0] != '#';) {
    Arguments command = words(line);
    ASSERT_EQ(command.at(0), "nbvopt");
    command.erase(command.begin());
    const fs::path summary = *(std::ranges::find(command, "--summary") + 1);
    const ProcessResult result = nbvopt_run(command);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    json expected = made.at(summary.stem().string());
    for (const char* key : {"schema", "unit", "name", "trajectory_digest"}) expected.erase(key);
    json told = json::parse(read_text_file(summary));
    told.erase("times_ms");
    EXPECT_EQ(told, expected);
    ++compared;
  }
  EXPECT_EQ(compared, 26U);
  EXPECT_EQ(file("out/units/apartment-1-trajectory.csv"), trajectory);
}

TEST_F(Reproduce, SurvivesKills) {
  ASSERT_EQ(nbvopt_run(arguments("whole")).exit_code, 0);
  std::mt19937_64 random(1);
  for (std::size_t done = 0; done < 8;) {
    BackgroundProcess process(cli_program(), arguments("killed"), folder / "killed.log");
    // In the midst of it: a record later, and somewhere in the next unit.
    ASSERT_TRUE(wait_until([&] { return records_so_far("killed") > done; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 50));
    process.send(SIGKILL);
    EXPECT_EQ(process.wait(), -1) << "it had ended before";
    done = records_so_far("killed");
  }
  ASSERT_EQ(nbvopt_run(arguments("killed")).exit_code, 0);
  for (const char* table :
       {"report.html", "table.md", "table.csv", "comparison.csv", "prediction.csv", "table.json"}) {
    EXPECT_EQ(file(std::string("killed/") + table), file(std::string("whole/") + table)) << table;
  }
}

TEST_F(Reproduce, PartsAndRanksMakeTheWhole) {
  const Arguments few{"--motion-time", "0.5"};
  const auto with = [&few](const Arguments& more) {
    Arguments all = few;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(nbvopt_run(arguments("whole", few)).exit_code, 0);
  for (const char* part : {"1", "2"}) {
    const ProcessResult result =
        nbvopt_run(arguments(part, with({"--shard", part + std::string("/2")})));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LT(records(part).size(), records("whole").size());
  }
  const ProcessResult merge =
      nbvopt_run({"reproduce", "merge", folder / "1", folder / "2", "--out", folder / "merged"});
  ASSERT_EQ(merge.exit_code, 0) << merge.err;
  EXPECT_EQ(records("merged"), records("whole"));
  ASSERT_EQ(nbvopt_run(arguments("merged", with({"--tables-only"}))).exit_code, 0);
  for (const char* table : {"report.html", "table.json"}) {
    EXPECT_EQ(file(std::string("merged/") + table), file(std::string("whole/") + table)) << table;
  }
  EXPECT_EQ(nbvopt_run(arguments("merged", with({"--shard", "3/2"}))).exit_code, 2);

  if (std::string(NBVOPT_MPIRUN).empty()) GTEST_SKIP() << "the rest: built without MPI";
  Arguments ranks{"--allow-run-as-root", "--oversubscribe", "-n", "3", cli_program()};
  std::ranges::copy(arguments("ranks", few), std::back_inserter(ranks));
  const ProcessResult result = run_process(NBVOPT_MPIRUN, ranks);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(records("ranks"), records("whole"));
  EXPECT_EQ(file("ranks/table.json"), file("whole/table.json"));
}

TEST_F(Reproduce, AStopKeepsWhatIsDone) {
  BackgroundProcess process(cli_program(), arguments("out"), folder / "stopped.log");
  ASSERT_TRUE(wait_until([&] { return records_so_far("out") > 1; }));
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), -1) << "it ends by the signal";
  EXPECT_THAT(file("stopped.log"), HasSubstr("the same command goes on where it was"));
  EXPECT_FALSE(fs::exists(folder / "out/table.md"));
  const std::size_t done = records("out").size();
  EXPECT_LT(done, 26U);
  const ProcessResult so_far = nbvopt_run(arguments("out", {"--tables-only"}));
  EXPECT_EQ(so_far.exit_code, 0) << so_far.err;
  EXPECT_EQ(so_far.out, file("out/table.md"));
  EXPECT_THAT(so_far.out, HasSubstr("did not run to their end: "));
  EXPECT_EQ(records("out").size(), done) << "nothing runs";
  const ProcessResult dry = nbvopt_run(arguments("out", {"--dry-run"}));
  EXPECT_THAT(dry.out, HasSubstr("# 26 commands, " + std::to_string(done) + " of them done"));
  EXPECT_EQ(nbvopt_run(arguments("out")).exit_code, 0);
  EXPECT_EQ(records("out").size(), 26U);
}

TEST_F(Reproduce, AFailedUnitIsToldAndLeavesAHole) {
  // No file can be made in the place of a folder.
  fs::create_directories(folder / "out/units/apartment-1-trajectory.csv/occupied");
  const ProcessResult result = nbvopt_run(arguments("out"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("nbvopt: unit apartment-1-trajectory failed: "),
                                HasSubstr("1 of 26 units failed; the tables in ")));
  EXPECT_THAT(result.out, HasSubstr("| 2D+auto (t=0.5): missing |"));
  EXPECT_EQ(result.out, file("out/table.md"));
  fs::remove_all(folder / "out/units/apartment-1-trajectory.csv");
  EXPECT_EQ(nbvopt_run(arguments("out")).exit_code, 0);
}

TEST_F(Reproduce, NoticesAChangedWorld) {
  ASSERT_EQ(nbvopt_run(arguments("out")).exit_code, 0);
  const std::string table = file("out/table.json");
  write_room_worlds(folder.path() / "worlds", 3.5);
  EXPECT_THAT(nbvopt_run(arguments("out", {"--dry-run"})).out,
              HasSubstr("# 26 commands, 0 of them done"));
  ASSERT_EQ(nbvopt_run(arguments("out")).exit_code, 0);
  EXPECT_NE(file("out/table.json"), table);
}

TEST_F(Reproduce, PlansThePapersExperimentByDefault) {
  ExperimentOptions all;
  all.worlds_folder = folder.path() / "worlds";
  const auto units = experiment_units(all);
  EXPECT_EQ(units.size(), 15U * 26U) << "three starts each; the bookstore is not there";
  for (const Unit& unit : units) EXPECT_EQ(unit.name.find(' '), std::string::npos);
}

TEST_F(Reproduce, CommandsAreQuotedForAShell) {
  ExperimentOptions odd;
  odd.worlds_folder = folder.path() / "worlds";
  odd.environments = {"apartment"};
  odd.folder.root = "it's here";
  EXPECT_THAT(command_line(experiment_units(odd)[0], odd.folder),
              HasSubstr("'it'\\''s here/units/apartment-1-trajectory.json'"));
}

TEST_F(Reproduce, TellsOfAMissingWorldBeforeAnythingRuns) {
  fs::remove_all(folder / "worlds/cafe");
  Arguments all{"reproduce", "--worlds", folder / "worlds", "--out", folder / "out"};
  all.push_back("--dry-run");
  const ProcessResult without = nbvopt_run(all);
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_THAT(without.err, AllOf(HasSubstr("cafe is left out: there is no "),
                                 HasSubstr("cafe/worlds/cafe_static_closed.world"),
                                 HasSubstr("bookstore is left out: there is no ")));
  EXPECT_THAT(without.out, testing::EndsWith("# 312 commands, 0 of them done\n"));
  all.back() = "--environments=apartment,cafe";
  const ProcessResult named = nbvopt_run(all);
  expect_refusal(named, 3, "cafe_static_closed.world: there is no such world");
  all[2] = folder / "nowhere";
  all.back() = "--starts=1";
  expect_refusal(nbvopt_run(all), 3, "none of the worlds is there, such as simple_house/");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

/// A room with a crate, laid out as the bookstore is: a world that names its models, which name
/// their meshes below the folder of all models.
void write_bookstore(const fs::path& worlds) {
  const fs::path model = worlds / "bookstore/models/Crate";
  fs::create_directories(model / "meshes");
  fs::create_directories(worlds / "bookstore/worlds");
  std::string world = room_world(5.0);
  world.insert(world.find("</world>"),
               "<include><uri>model://Crate</uri><pose>1.5 0 0 0 0 0</pose></include>");
  std::ofstream(worlds / "bookstore/worlds/bookstore.world") << world;
  std::ofstream(model / "model.config")
      << "<model><name>Crate</name><sdf version='1.6'>model.sdf</sdf></model>";
  std::ofstream(model / "model.sdf")
      << "<sdf version='1.6'><model name='Crate'><static>1</static><link name='l'><visual name='v'>"
         "<geometry><mesh><uri>file://models/Crate/meshes/crate.obj</uri></mesh></geometry>"
         "</visual></link></model></sdf>";
  std::ofstream(model / "meshes/crate.obj") << "v -0.4 -0.4 0\nv 0.4 -0.4 0\nv 0 0.4 0\nv 0 0 0.8\n"
                                               "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

TEST_F(Reproduce, FillsTheRowsOfTheBookstoreOnceItIsThere) {
  const Arguments bookstore{"reproduce",
                            "--worlds",
                            folder / "worlds",
                            "--out",
                            folder / "out",
                            "--environments",
                            "bookstore",
                            "--duration-max",
                            "2",
                            "--explore",
                            "2d",
                            "--motion-time",
                            "1"};
  write_bookstore(folder.path() / "worlds");
  const ProcessResult result = nbvopt_run(bookstore);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(file("out/table.csv"), HasSubstr("\nbookstore (15x14),2D+auto,1,"));
  EXPECT_TRUE(json::parse(file("out/table.json"))["missing"].empty());
  const json drive = records("out").at("bookstore-1-trajectory");
  EXPECT_FALSE(drive.contains("warnings")) << drive["warnings"] << ": the crate is found";
  // Free by check: elsewhere a base cannot start.
  EXPECT_GT(drive.at("duration_s"), 1.9);

  fs::remove_all(folder / "worlds/bookstore/models");
  EXPECT_EQ(nbvopt_run(bookstore).exit_code, 0);
  EXPECT_NE(file("out/records.jsonl").find("model://Crate"), std::string::npos)
      << "the record of the drive says what is missing";
}

TEST_F(Reproduce, RefusesWrongCommandLines) {
  const auto refuse = [&](const Arguments& more, int code, const std::string& named) {
    Arguments all{"reproduce", "--worlds", folder / "worlds", "--out", folder / "out"};
    all.insert(all.end(), more.begin(), more.end());
    expect_refusal(nbvopt_run(all), code, named);
  };
  refuse({"--environments", "apartment,moon"}, 2, "'moon' is none of simple_house, apartment");
  refuse({"--starts", "0"}, 3, "--starts is 0");
  refuse({"--jobs", "many"}, 2, "--jobs: 'many'");
  refuse({"--explore", "2d,4d"}, 2, "--explore: 4d not in {2d,3d,");
  refuse({"--motion-time", "0.4"}, 2, "--motion-time: 0.4 not in {0.2,0.5,1}");
  refuse({"--duration-max", "inf"}, 3, "--duration-max is inf");
  expect_refusal(nbvopt_run({"reproduce", "--out", "x"}), 2, "--worlds");
  expect_refusal(nbvopt_run({"reproduce", "--worlds", folder / "worlds", "--out", "/dev/null/x"}),
                 3, "/dev/null/x");
}

TEST_F(Reproduce, WorkersAnswerLineByLine) {
  const ProcessResult result =
      nbvopt_run({"reproduce", "worker"}, "{\"unit\":\"1\",\"world\":3}\n");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  std::string hello;
  std::string answer;
  ASSERT_TRUE(std::getline(lines, hello) && std::getline(lines, answer));
  EXPECT_EQ(json::parse(hello).at("protocol"), 1);
  EXPECT_EQ(json::parse(answer).at("unit"), "1");
  EXPECT_THAT(json::parse(answer).at("failure").get<std::string>(), HasSubstr("unit: "));
}

TEST_F(Reproduce, ExplainsItself) {
  const ProcessResult help = nbvopt_run({"reproduce", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("Usage: nbvopt reproduce"), HasSubstr("--dry-run")));
}

}  // namespace
}  // namespace nbvopt::test
