// A reproduction in parts, and on engines with workers of their own.
#include "reproduction/merge.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <sstream>

#include "core/text_file.hpp"
#include "experiment/process_pool.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/reproduction_run.hpp"
#include "reproduction/room_worlds.hpp"
#include "reproduction/table.hpp"
#include "reproduction/text.hpp"
#include "reproduction/unit_runner.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReproductionInParts : public testing::Test {
 protected:
  ReproductionInParts() { write_room_worlds(folder.path() / "worlds"); }

  /// Four starts, by all explorers: twenty drives.
  ExperimentOptions options(const std::string& out, const experiment::Shard& shard = {}) const {
    ExperimentOptions options;
    options.worlds_folder = folder.path() / "worlds";
    options.folder.root = folder.path() / out;
    options.environments = {"apartment", "willowgarage"};
    options.starts = 2;
    options.shard = shard;
    return options;
  }

  static std::vector<Unit> units_of(const ExperimentOptions& options) {
    std::vector<Unit> units = experiment_units(options);
    read_worlds(units);
    return units;
  }

  /// Runs it on workers that simulate nothing.
  ReproductionFolder run(const ExperimentOptions& options) const {
    experiment::ProcessPool pool({NBVOPT_ODD_SIMULATOR, folder / "calls"}, 2);
    const auto result =
        run_reproduction(units_of(options), options.folder, pool, [](const Json&) {});
    EXPECT_EQ(result.failed, 0U);
    return options.folder;
  }

  /// What there is to do, as lines.
  static std::vector<Json> listed(const ExperimentOptions& options) {
    std::vector<Unit> units = experiment_units(options);
    build_worlds(units, options.folder);
    std::vector<Json> lines;
    list_units(units, options.folder,
               [&](const std::string& line) { lines.push_back(Json::parse(line)); });
    return lines;
  }

  static std::string table(const ExperimentOptions& options) {
    const std::vector<Unit> units = units_of(options);
    return to_text(to_json(make_table(units, read_results(units, options.folder))));
  }

  const TemporaryFolder folder;
};

TEST_F(ReproductionInParts, MakesTheWhole) {
  run(options("whole"));
  std::vector<ReproductionFolder> parts;
  std::multiset<std::string> names;
  for (std::size_t i = 0; i < 4; ++i) {
    const ExperimentOptions part = options("part" + std::to_string(i), {i, 4});
    for (const Unit& unit : experiment_units(part)) names.insert(unit.name);
    parts.push_back(run(part));
  }
  std::multiset<std::string> all_names;
  for (const Unit& unit : experiment_units(options("whole"))) all_names.insert(unit.name);
  EXPECT_EQ(names, all_names) << "each is of one part";

  const experiment::MergeCount count = merge_reproductions(parts, {folder.path() / "merged"});
  EXPECT_EQ(count.added, all_names.size());
  EXPECT_EQ(table(options("merged")), table(options("whole")));
  EXPECT_EQ(listed(options("merged")).size(), 0U) << "nothing is left to do";

  const experiment::MergeCount again = merge_reproductions(parts, {folder.path() / "merged"});
  EXPECT_EQ(again.added, 0U);
  EXPECT_EQ(again.repeated, all_names.size());
}

TEST_F(ReproductionInParts, MayLieWithOtherWorldsFolders) {
  const ReproductionFolder a = run(options("a", {0, 2}));
  std::filesystem::rename(folder.path() / "worlds", folder.path() / "elsewhere");
  ExperimentOptions moved = options("b");
  moved.worlds_folder = folder.path() / "elsewhere";
  const ReproductionFolder b = run(moved);
  merge_reproductions(std::vector{a, b}, {folder.path() / "merged"});
  moved.folder.root = folder.path() / "merged";
  EXPECT_EQ(listed(moved).size(), 0U);
}

TEST_F(ReproductionInParts, OtherDrivesAndContradictionsAreRefused) {
  const ReproductionFolder a = run(options("a"));
  ExperimentOptions longer = options("b");
  longer.duration_max_s = 30.0;
  const ReproductionFolder b = run(longer);
  const ReproductionFolder into{folder.path() / "merged"};
  const auto refusal = [&](const std::vector<ReproductionFolder>& parts) {
    return message_of<InputError>([&] { merge_reproductions(parts, into); });
  };
  EXPECT_THAT(refusal({a, b}), AllOf(HasSubstr(a.units().string()), HasSubstr(b.units().string()),
                                     HasSubstr("is another drive")));
  const ReproductionFolder c = run(options("c"));
  std::string text = read_text_file(c.records());
  text.replace(text.find("\"voxels\":"), 9, "\"voxels\":1");
  std::ofstream(c.records(), std::ios::binary) << text;
  EXPECT_THAT(refusal({a, c}), AllOf(HasSubstr(a.root.string()), HasSubstr(c.root.string()),
                                     HasSubstr("says something else")));
  EXPECT_THAT(refusal({a, {folder.path() / "none"}}), HasSubstr("none holds no reproduction"));
  EXPECT_FALSE(std::filesystem::exists(into.root)) << "nothing half-written";
}

TEST_F(ReproductionInParts, AnEngineLearnsFilesAndOrder) {
  const std::vector<Json> lines = listed(options("out", {0, 20}));
  ASSERT_EQ(lines.size(), 1 + episode_settings().size());
  const Json& drive = lines.front();
  EXPECT_FALSE(drive.at("engine").contains("after"));
  EXPECT_EQ(drive.at("engine").at("reads"), Json({"/world/built"}));
  EXPECT_EQ(drive.at("engine").at("writes"), Json({"/trajectory"}));
  bool draws = false;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Json& engine = lines[i].at("engine");
    EXPECT_EQ(engine.at("after"), drive.at("unit"));
    EXPECT_EQ(engine.at("reads"), Json({"/world/built", "/trajectory"}));
    draws = draws || engine.at("writes") == Json({"/picture"});
  }
  EXPECT_TRUE(draws);
}

TEST_F(ReproductionInParts, AnEnginesAnswersAreKept) {
  const ExperimentOptions experiment = options("out", {0, 20});
  const std::vector<Json> lines = listed(experiment);
  const std::string trajectory = lines.front().at("trajectory");
  std::ofstream(trajectory) << "what a worker elsewhere wrote";
  const Json answer{{"unit", lines.front().at("unit")},
                    {"answer", {{"trajectory_digest", "of something else"}}},
                    {"busy_ms", 1.0}};
  std::istringstream answers(answer.dump() + "\n" + answer.dump() + "\nrubbish\n");
  std::vector<std::string> kept;
  EXPECT_THAT(message_of<InputError>([&] {
                record_answers(units_of(experiment), experiment.folder, answers,
                               [&](const std::string& id) { kept.push_back(id); });
              }),
              HasSubstr("answers: line 3: is no answer to a unit of this experiment: rubbish"));
  EXPECT_EQ(kept, std::vector<std::string>(2, lines.front().at("unit")));
  const std::string records = read_text_file(experiment.folder.records());
  EXPECT_EQ(std::ranges::count(records, '\n'), 1) << "a unit's answer is kept once";
}

TEST_F(ReproductionInParts, ABuiltWorldIsTheWorld) {
  std::vector<Unit> units = experiment_units(options("out"));
  build_worlds(units, options("out").folder);
  std::filesystem::remove_all(folder.path() / "worlds");
  const WorldSource& source = units.front().simulation.world;
  EXPECT_EQ(world_digest(read_world(source)), source.digest);
  std::ofstream(*source.built, std::ios::app) << "more";
  EXPECT_THAT(message_of<InputError>([&] { read_world(source); }),
              AllOf(HasSubstr(source.built->string()), HasSubstr("is damaged")));
}

}  // namespace
}  // namespace nbvopt::test
