#include "reproduction/table.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "reproduction/page.hpp"
#include "reproduction/text.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The experiment in the apartment and the cafe, with results made up by a test.
class Reproduction : public testing::Test {
 protected:
  Reproduction() {
    for (const ExperimentEnvironment& environment : experiment_environments()) {
      const std::filesystem::path world = folder.path() / environment.world_file;
      std::filesystem::create_directories(world.parent_path());
      std::ofstream(world) << "<sdf/>";
    }
    options.worlds_folder = folder.path();
    options.folder.root = "out";
    options.environments = {"cafe", "apartment"};
    units = experiment_units(options);
    results.resize(units.size());
    const auto all = experiment_environments();
    missing = {&*std::ranges::find(all, "bookstore", &ExperimentEnvironment::name)};
    for (std::size_t i = 0; i < units.size(); ++i) {
      if (units[i].is_drive()) results[i].drive = {.duration_s = 200.0, .length_m = 40.0};
    }
  }

  UnitResult& at(const std::string& name) {
    const auto unit = std::ranges::find(units, name, &Unit::name);
    EXPECT_NE(unit, units.end()) << name;
    return results[static_cast<std::size_t>(unit - units.begin())];
  }

  /// As the authors count, there is twice as much, and 10 more.
  static EpisodeReport episode(std::uint64_t voxels, double information) {
    EpisodeReport record;
    record.summary.duration_s = 100.0;
    record.summary.voxels = voxels;
    record.summary.information = information;
    record.paper_counts = {.voxels = 2 * voxels, .information = 2.0 * information + 10.0};
    return record;
  }

  ReproductionTable table() const { return make_table(units, results, missing); }

  static const ResultRow& row(const ReproductionTable& table, const std::string& environment,
                              const std::string& test, std::optional<double> motion_time_s) {
    const auto found = std::ranges::find_if(table.results, [&](const ResultRow& row) {
      return row.environment.starts_with(environment) && row.test == test &&
             row.motion_time_s == motion_time_s;
    });
    EXPECT_NE(found, table.results.end()) << environment << ' ' << test;
    return *found;
  }

  const TemporaryFolder folder;
  ExperimentOptions options;
  std::vector<Unit> units;
  std::vector<UnitResult> results;
  std::vector<const ExperimentEnvironment*> missing;
};

TEST_F(Reproduction, HasARowForEveryTestInThePapersOrder) {
  std::vector<std::string> environments;
  std::vector<std::string> tests;
  for (const ResultRow& row : table().results) {
    if (environments.empty() || environments.back() != row.environment) {
      environments.push_back(row.environment);
    }
    if (row.environment == "cafe (25x10)") tests.push_back(row.test);
  }
  EXPECT_THAT(environments, ElementsAre("apartment (19x11)", "bookstore (15x14)", "cafe (25x10)"));
  EXPECT_THAT(tests, ElementsAre("2D", "2D+grid", "2D+auto", "2D+auto expected", "2D+oracle", "2D",
                                 "2D+grid", "2D+grid-3", "2D+auto", "2D+auto expected", "2D+random",
                                 "2D+oracle", "2D", "2D+grid", "2D+auto", "2D+auto expected",
                                 "2D+oracle", "3D", "3D tekniker", "3D after 2D", "NBV"));
}

TEST_F(Reproduction, FiguresAreMeansOverTheStartsAgainstTheStillCameraOfTheSameTime) {
  at("cafe-1-static-0.5").episode = episode(1000, 500);
  at("cafe-2-static-0.5").episode = episode(2000, 700);
  at("cafe-1-auto-0.5").episode = episode(1500, 800);
  at("cafe-2-auto-0.5").episode = episode(3000, 1000);
  at("cafe-1-static-1").episode = episode(2000, 2000);
  at("cafe-1-auto-1").episode = episode(2000, 2500);
  const ReproductionTable made = table();

  const ResultRow& still = row(made, "cafe", "2D", 0.5);
  EXPECT_EQ(still.voxels, 1500.0);
  EXPECT_EQ(still.information, 600.0);
  EXPECT_EQ(still.gain, std::nullopt);

  const ResultRow& best = row(made, "cafe", "2D+auto", 0.5);
  EXPECT_EQ(best.drives, 2.0);
  EXPECT_EQ(best.voxels, 2250.0);
  EXPECT_NEAR(best.voxels_percent.value(), 50.0, 1e-12);
  EXPECT_EQ(best.information, 900.0);
  EXPECT_EQ(best.information_least, 800.0);
  EXPECT_EQ(best.information_most, 1000.0);
  EXPECT_EQ(best.gain, 300.0);
  EXPECT_NEAR(best.gain_percent.value(), 50.0, 1e-12);
  EXPECT_EQ(best.duration_s, 100.0);
  EXPECT_EQ(best.voxels_per_s, 22.5);
  EXPECT_EQ(best.information_per_s, 9.0);
  EXPECT_NEAR(best.as_paper_counts_voxels_percent.value(), 50.0, 1e-12);
  EXPECT_NEAR(best.as_paper_counts_gain_percent.value(), 100.0 * (1810.0 / 1210.0 - 1.0), 1e-12);
  EXPECT_EQ(row(made, "cafe", "2D+auto", 1.0).gain, 500.0);
}

TEST_F(Reproduction, TellsHowFastTheMapGrewAndWhatIsMissingToTheOracle) {
  for (const int start : {1, 2}) {
    const std::string drive = "cafe-" + std::to_string(start);
    EpisodeReport known = episode(1000, 1000);
    known.summary.growth.add(0.0, 500);
    known.summary.growth.add(10.0 * start, 850);
    known.summary.growth.add(50.0, 1000);
    at(drive + "-auto-expected-0.5").episode = known;
    known = episode(1000, 800);
    known.summary.growth.add(0.0, 0);
    known.summary.growth.add(40.0, 800);
    at(drive + "-auto-0.5").episode = known;
  }
  at("cafe-1-oracle-0.5").episode = episode(1000, 1000);
  const ReproductionTable made = table();
  const ResultRow& expected = row(made, "cafe", "2D+auto expected", 0.5);
  EXPECT_EQ(expected.time_to_50_percent_s, 0.0);
  EXPECT_EQ(expected.time_to_80_percent_s, 15.0);
  EXPECT_EQ(expected.time_to_90_percent_s, 50.0);
  EXPECT_EQ(expected.mean_information,
            ((500 * 10 + 850 * 40 + 1000 * 50) + (500 * 20 + 850 * 30 + 1000 * 50)) / 200.0);
  EXPECT_EQ(expected.regret_percent, 0.0);
  const ResultRow& positive = row(made, "cafe", "2D+auto", 0.5);
  EXPECT_EQ(positive.time_to_80_percent_s, 40.0);
  EXPECT_EQ(positive.time_to_90_percent_s, std::nullopt) << "of 1000";
  EXPECT_NEAR(positive.regret_percent.value(), 20.0, 1e-12) << "at the start that has an oracle";
  EXPECT_EQ(row(made, "cafe", "2D+oracle", 0.5).regret_percent, 0.0);
}

TEST_F(Reproduction, AnotherExplorationIsComparedWithTheStillCameraInThePlane) {
  at("cafe-1-static-0.5").episode = episode(1000, 500);
  at("cafe-2-static-0.5").episode = episode(3000, 900);
  at("cafe-1-3d-static-0.5").episode = episode(1500, 800);
  at("cafe-1-3d-tekniker-static-0.5").episode = episode(800, 400);
  at("cafe-2-3d-after-2d-static-0.5").episode = episode(3000, 1000);
  at("cafe-1-nbv-auto-expected-0.5").episode = episode(1600, 1100);
  const ReproductionTable made = table();
  const ResultRow& spatial = row(made, "cafe", "3D", 0.5);
  EXPECT_EQ(spatial.drives, 1.0);
  EXPECT_EQ(spatial.information, 800.0);
  EXPECT_EQ(spatial.gain, 300.0);
  EXPECT_NEAR(spatial.voxels_percent.value(), 50.0, 1e-12);
  EXPECT_EQ(row(made, "cafe", "3D tekniker", 0.5).gain, -100.0);
  EXPECT_EQ(row(made, "cafe", "3D after 2D", 0.5).gain, 100.0);
  EXPECT_EQ(row(made, "cafe", "NBV", 0.5).gain, 600.0);
  // It learns on another drive, which the others are not held against.
  EXPECT_EQ(row(made, "cafe", "2D", 0.5).information, 700.0);
  EXPECT_EQ(row(made, "apartment", "3D", 0.5).remark, "missing");
}

TEST_F(Reproduction, ComparesAfterThePapersDurationsToo) {
  // In the cafe the paper's drive in the plane takes 227 s, its 3D exploration 2,274 s.
  const auto episode_that_grows = [](double first, double then_s, double last) {
    EpisodeReport report = episode(1000, last);
    report.summary.growth.add(0.0, first);
    report.summary.growth.add(then_s, last);
    return report;
  };
  at("cafe-1-static-0.5").episode = episode_that_grows(400, 300.0, 1000);
  at("cafe-1-auto-0.5").episode = episode_that_grows(600, 300.0, 1500);
  at("cafe-1-3d-static-0.5").episode = episode_that_grows(500, 2000.0, 1200);
  at("cafe-1-nbv-auto-expected-0.5").episode = episode_that_grows(700, 300.0, 2000);
  const ReproductionTable made = table();
  EXPECT_EQ(row(made, "cafe", "2D", 0.5).gain_percent_in_papers_time, std::nullopt);
  EXPECT_NEAR(row(made, "cafe", "2D+auto", 0.5).gain_percent_in_papers_time.value(), 50.0, 1e-12);
  EXPECT_NEAR(row(made, "cafe", "3D", 0.5).gain_percent_in_papers_time.value(), 200.0, 1e-12);
  EXPECT_NEAR(row(made, "cafe", "NBV", 0.5).gain_percent_in_papers_time.value(), 75.0, 1e-12);
}

TEST_F(Reproduction, SeedsAreDrivesOfTheirOwn) {
  options.environments = {"cafe"};
  options.starts = 1;
  options.seed = 7;
  options.seeds = 2;
  units = experiment_units(options);
  results.assign(units.size(), {});
  at("cafe-1-static-0.5").episode = episode(1000, 500);
  at("cafe-1-auto-0.5").episode = episode(1000, 600);
  at("cafe-1-seed-8-static-0.5").episode = episode(1000, 700);
  at("cafe-1-seed-8-auto-0.5").episode = episode(1000, 1000);
  at("cafe-1-seed-8-3d-static-0.5").episode = episode(1000, 800);
  const ReproductionTable made = table();
  const ResultRow& looking = row(made, "cafe", "2D+auto", 0.5);
  EXPECT_EQ(looking.drives, 2.0);
  EXPECT_EQ(looking.information, 800.0);
  EXPECT_EQ(looking.information_least, 600.0);
  EXPECT_EQ(looking.information_most, 1000.0);
  EXPECT_EQ(row(made, "cafe", "3D", 0.5).gain, 100.0) << "against the drive of the same seed";
  EXPECT_EQ(made.comparisons.front().pairs, 2U);
  for (const Unit& unit : units) {
    const bool is_second = unit.name.find("seed-8") != std::string::npos;
    EXPECT_EQ(unit.simulation.seed, is_second ? 8U : 7U);
    EXPECT_TRUE(!is_second || unit.simulation.picture.empty()) << "one picture is enough";
  }
}

TEST_F(Reproduction, TestsThatAreLeftOutHaveNoRows) {
  options.explorers = {ExplorerKind::plane, ExplorerKind::views};
  options.motion_times_s = {0.5, 1.0};
  units = experiment_units(options);
  results.assign(units.size(), {});
  std::vector<std::string> tests;
  for (const ResultRow& row : table().results) {
    if (row.environment == "cafe (25x10)") tests.push_back(row.test);
  }
  EXPECT_EQ(std::ranges::count(table().results, "bookstore (15x14)", &ResultRow::environment), 3)
      << "2D, and the grid at two t";
  EXPECT_THAT(tests, ElementsAre("2D", "2D+grid", "2D+grid-3", "2D+auto", "2D+auto expected",
                                 "2D+random", "2D+oracle", "2D", "2D+grid", "2D+auto",
                                 "2D+auto expected", "2D+oracle", "NBV"));
  options.motion_times_s = {1.0};
  EXPECT_EQ(experiment_units(options).size(), 2U * 3U * (1U + 5U))
      << "on a drive for views nothing runs at t = 1 s";
}

TEST_F(Reproduction, WillowgarageIsLargerThanThePapersDriveInThePlane) {
  options.environments = {"willowgarage"};
  options.starts = 1;
  for (const Unit& unit : experiment_units(options)) {
    const auto* drive = std::get_if<DriveSetting>(&unit.simulation.setting);
    if (drive == nullptr) continue;
    const bool is_ours = drive->explorer == ExplorerKind::views;
    const bool is_planar = drive->explorer == ExplorerKind::plane;
    EXPECT_EQ(drive->duration_max_s, is_planar ? 1615.0 : is_ours ? 40271.0 / 3.0 : 40271.0);
  }
}

TEST_F(Reproduction, ADriveOfThePapersInSpaceEndsWithThePapers) {
  for (const Unit& unit : units) {
    const auto* drive = std::get_if<DriveSetting>(&unit.simulation.setting);
    if (drive == nullptr) continue;
    const bool is_ours =
        drive->explorer == ExplorerKind::plane || drive->explorer == ExplorerKind::views;
    const double papers_s = unit.environment->name == "cafe" ? 2274.0 : 3018.0;
    EXPECT_EQ(drive->duration_max_s, is_ours ? 3600.0 : papers_s) << unit.name;
    if (!is_ours) at(unit.name).drive->status = ExplorationStatus::time_limit;
  }
  EXPECT_THAT(table().incomplete, ElementsAre());
  at("cafe-1-nbv-trajectory").drive->status = ExplorationStatus::time_limit;
  EXPECT_THAT(table().incomplete, ElementsAre("cafe-1-nbv-trajectory"));
}

TEST_F(Reproduction, ThePapersFiguresStandBesideItsOwnTests) {
  const ReproductionTable made = table();
  EXPECT_EQ(row(made, "cafe", "2D", 0.2).paper->voxels, 69'566);
  EXPECT_EQ(row(made, "cafe", "2D+grid", 1.0).paper->gain_percent, 57.53);
  EXPECT_EQ(row(made, "cafe", "3D", 0.5).paper->information, 74'196);
  EXPECT_EQ(row(made, "cafe", "3D tekniker", 0.5).paper, nullptr);
  EXPECT_EQ(row(made, "bookstore", "3D", std::nullopt).paper->information, 91'666);
  EXPECT_EQ(row(made, "cafe", "2D+auto", 0.5).paper, nullptr);
  EXPECT_EQ(row(made, "cafe", "2D+grid-3", 0.5).paper, nullptr);
  EXPECT_EQ(row(made, "bookstore", "2D+grid", 0.5).paper->gain_percent, 18.71);
  EXPECT_EQ(row(made, "bookstore", "2D+grid", 0.5).remark,
            "there is no bookstore/worlds/bookstore.world");
}

TEST_F(Reproduction, PercentagesCompareOnlyStartsThatHaveBoth) {
  at("cafe-1-static-0.5").episode = episode(1000, 500);
  at("cafe-3-static-0.5").episode = episode(9000, 9000);
  at("cafe-1-grid-0.5").episode = episode(1100, 600);
  at("cafe-2-grid-0.5").episode = episode(3000, 3000);
  const ReproductionTable made = table();
  const ResultRow& grid = row(made, "cafe", "2D+grid", 0.5);
  EXPECT_EQ(grid.drives, 2.0);
  EXPECT_EQ(grid.information, 1800.0);
  EXPECT_EQ(grid.gain, 100.0);
  EXPECT_NEAR(grid.gain_percent.value(), 20.0, 1e-12);
}

TEST_F(Reproduction, HolesAreNamed) {
  at("cafe-1-grid-0.5").episode = episode(1000, 500);
  at("apartment-2-trajectory").drive.reset();
  at("apartment-3-trajectory").drive->status = ExplorationStatus::time_limit;
  const ReproductionTable made = table();
  EXPECT_EQ(row(made, "cafe", "2D+grid", 0.5).gain, std::nullopt) << "nothing to compare with";
  EXPECT_EQ(row(made, "cafe", "2D+auto", 0.5).remark, "missing");
  EXPECT_THAT(made.missing, testing::Contains("apartment-2-trajectory"));
  EXPECT_THAT(made.missing, testing::Contains("cafe-1-auto-1"));
  EXPECT_THAT(made.missing, Not(testing::Contains("cafe-1-grid-0.5")));
  EXPECT_THAT(made.incomplete, ElementsAre("apartment-3-trajectory"));
  const std::string markdown = to_markdown(made);
  EXPECT_THAT(markdown, HasSubstr("did not run to their end: apartment-2-trajectory, "));
  EXPECT_THAT(markdown, HasSubstr(" and " + std::to_string(made.missing.size() - 12) +
                                  " more, which table.json names."));
  EXPECT_THAT(markdown, HasSubstr("for lack of time: apartment-3-trajectory."));
}

TEST_F(Reproduction, PredictionsArePooledOverStartsAndEnvironments) {
  // Steps (x, y): (1, 1), (2, 3) in the apartment and (3, 2) in the cafe.
  at("apartment-1-auto-0.5").episode = episode(1, 1);
  at("apartment-1-auto-0.5").episode->summary.prediction = {2, 3, 4, 5, 10, 7};
  at("cafe-2-auto-0.5").episode = episode(1, 1);
  at("cafe-2-auto-0.5").episode->summary.prediction = {1, 3, 2, 9, 4, 6};
  const ReproductionTable made = table();
  ASSERT_EQ(made.predictions.size(), 3U);
  const PredictionRow& all = made.predictions[0];
  EXPECT_EQ(all.environment, "all");
  EXPECT_EQ(all.test, "2D+auto");
  EXPECT_EQ(all.record.steps, 3U);
  EXPECT_NEAR(all.record.correlation(), 0.5, 1e-12);
  EXPECT_NEAR(all.record.bias(), 0.0, 1e-12);
  EXPECT_EQ(made.predictions[1].environment, "apartment");
  EXPECT_NEAR(made.predictions[1].record.correlation(), 1.0, 1e-12);
  EXPECT_NEAR(made.predictions[1].record.bias(), -0.25, 1e-12);
  EXPECT_TRUE(std::isnan(made.predictions[2].record.correlation())) << "of a single step";
}

TEST_F(Reproduction, TestsAreComparedOnTheStartsThatBothHave) {
  at("cafe-1-auto-0.5").episode = episode(1, 110);
  at("cafe-1-grid-0.5").episode = episode(1, 100);
  at("apartment-1-auto-0.5").episode = episode(1, 90);
  at("apartment-1-grid-0.5").episode = episode(1, 100);
  at("apartment-2-auto-0.5").episode = episode(1, 150);
  at("apartment-2-grid-0.5").episode = episode(1, 100);
  at("apartment-3-auto-0.5").episode = episode(1, 150);
  at("apartment-3-grid-1").episode = episode(1, 100);
  const std::vector<PairedComparison> all = table().comparisons;
  ASSERT_EQ(all.size(), 1U);
  const PairedComparison& row = all[0];
  EXPECT_EQ(row.test, "2D+auto");
  EXPECT_EQ(row.other, "2D+grid");
  EXPECT_EQ(row.motion_time_s, 0.5);
  EXPECT_EQ(row.pairs, 3U);
  EXPECT_EQ(row.better, 2U);
  EXPECT_NEAR(row.mean_percent, 50.0 / 3.0, 1e-12);
  EXPECT_NEAR(row.least_percent, -10.0, 1e-12);
  EXPECT_NEAR(row.most_percent, 50.0, 1e-12);
  EXPECT_NEAR(row.p, 0.75, 1e-12) << "on either side 3 of the 8 ways to sign them are as odd";
  at("cafe-1-3d-static-0.5").episode = episode(1, 220);
  ASSERT_EQ(table().comparisons.size(), 2U);
  EXPECT_EQ(table().comparisons[1].other, "3D");
  EXPECT_NEAR(table().comparisons[1].mean_percent, -50.0, 1e-12);
  at("cafe-1-nbv-auto-expected-0.5").episode = episode(1, 440);
  const PairedComparison last = table().comparisons.back();
  EXPECT_EQ(last.test + " against " + last.other, "NBV against 3D");
  EXPECT_NEAR(last.mean_percent, 100.0, 1e-12);
  EXPECT_THAT(to_markdown(table()), HasSubstr("| 2D+auto | 2D+grid | 0.5 | 3 | 2 | 16.67% |"));
}

TEST_F(Reproduction, ThePageNeedsNoOtherFile) {
  for (const char* name : {"cafe-1-static-0.5", "cafe-2-static-0.5", "cafe-1-auto-0.5"}) {
    UnitResult& result = at(name);
    result.episode = episode(1000, 500);
    result.episode->summary.growth.add(0.0, 100);
    result.episode->summary.growth.add(60.0, 500);
  }
  std::filesystem::path picture;
  for (Unit& unit : units) {
    std::filesystem::path& of_unit = unit.simulation.picture;
    const bool is_first_start = unit.name.ends_with("-0.5") && unit.start == 1;
    EXPECT_EQ(!of_unit.empty(), is_first_start) << unit.name;
    if (!of_unit.empty()) of_unit = folder.path() / of_unit.filename();
    if (unit.name == "cafe-1-auto-0.5") picture = of_unit;
  }
  std::ofstream(picture) << "foo";
  const std::string page = to_html(table(), units, results);
  EXPECT_THAT(page, testing::StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(page, testing::EndsWith("</html>\n"));
  EXPECT_THAT(page, HasSubstr("<h3>cafe</h3>"));
  EXPECT_THAT(page, Not(HasSubstr("<h3>apartment</h3>"))) << "nothing ran there";
  EXPECT_THAT(page, HasSubstr("Information over time: cafe, t = 0.5 s\" src=\"data:image/png;"));
  EXPECT_THAT(page, HasSubstr("The map by 2D+auto, t = 0.5 s, start 1\" "
                              "src=\"data:image/png;base64,Zm9v\""));
  EXPECT_THAT(page, Not(HasSubstr("2D+grid, t = 0.5 s, start 1"))) << "it has no picture";
  EXPECT_THAT(page, Not(HasSubstr("http"))) << "it must stand alone";
}

TEST_F(Reproduction, MarkdownIsRoundedAsInThePaper) {
  at("cafe-1-static-0.5").episode = episode(12345, 1000);
  at("cafe-1-grid-0.5").episode = episode(1234567, 987.654);
  at("cafe-1-grid-0.5").episode->summary.prediction = {2, 3, 4, 5, 10, 7};
  const std::string markdown = to_markdown(table());
  EXPECT_THAT(
      markdown,
      HasSubstr("| 2D (t=0.5) | 1 | 12,345 | - | 1,000 | 1,000 | 1,000 | - | - | - | - | 100 | "
                "123 | 10 |"));
  EXPECT_THAT(
      markdown,
      HasSubstr("| 2D+grid (t=0.5) | 1 | 1,234,567 | 9900.54% | 988 | 988 | 988 | - | \u221212 | "
                "\u22121.23% | - | 100 |"));
  EXPECT_THAT(markdown, HasSubstr("| 49.50% | 56.35% | 227 | 245 |\n"));
  EXPECT_THAT(markdown, HasSubstr("| all | 2D+grid (t=0.5) | 2 | 1.000 | \u221225.00% |\n"));
  EXPECT_THAT(
      markdown,
      HasSubstr("| bookstore (15x14) | 2D: there is no bookstore/worlds/bookstore.world |"));
  EXPECT_THAT(markdown, HasSubstr("|  | 3D (t=0.5): missing |"));
}

TEST_F(Reproduction, CsvAndJsonHoldAllFiguresUnrounded) {
  at("cafe-1-static-0.5").episode = episode(1000, 500);
  at("cafe-1-grid-0.5").episode = episode(1003, 500.5);
  const ReproductionTable made = table();
  const std::string csv = to_csv(result_table(made));
  EXPECT_THAT(csv, testing::StartsWith("environment,test,motion_time_s,drives,voxels,"));
  EXPECT_THAT(csv, HasSubstr("\ncafe (25x10),2D+grid,0.5,1,1003,"));
  EXPECT_THAT(csv, HasSubstr(",103998,49.5,55636,20051,56.35,227,0,457,245\n"));
  const auto columns = [](const std::string& line) { return std::ranges::count(line, ','); };
  const std::string header = csv.substr(0, csv.find('\n'));
  const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  EXPECT_EQ(columns(header), columns(last));
  EXPECT_THAT(to_csv(prediction_table(made)),
              testing::StartsWith("environment,test,motion_time_s,steps,predicted_sum,"));

  const Json json = to_json(made);
  EXPECT_EQ(json["results"].size(), made.results.size());
  const auto found = std::ranges::find_if(json["results"], [](const Json& row) {
    return row["environment"] == "cafe (25x10)" && row["test"] == "2D+grid" &&
           row["motion_time_s"] == 0.5;
  });
  ASSERT_NE(found, json["results"].end());
  EXPECT_EQ((*found)["information"], 500.5);
  EXPECT_EQ((*found)["paper_information"], 55'636.0);
  EXPECT_EQ(json["results"][0]["gain"], nullptr);
  EXPECT_EQ(json["missing"].size(), made.missing.size());
}

}  // namespace
}  // namespace nbvopt::test
