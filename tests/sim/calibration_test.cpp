#include "sim/calibration.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/calibration_report.hpp"
#include "sim/room.hpp"

namespace nbvopt::test {
namespace {

using testing::HasSubstr;

HazardTable counted(double hits, double metres) {
  HazardTable table;
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) table.set(c, {hits, metres});
  return table;
}

TEST(PooledPrior, CountsTogetherAndWeighsTwoMetres) {
  HazardTable first = counted(3.0, 1.0);
  first.set(4, {});
  HazardTable second = counted(1.0, 7.0);
  second.set(4, {});
  const HazardTable prior = pooled_prior(std::vector{first, second}, 0.25);
  EXPECT_EQ(prior.floor_map_m(), 0.25);
  EXPECT_EQ(prior.count(0), (HazardCount{.hits = 1.0, .metres = 2.0})) << "4 hits in 8 m";
  EXPECT_EQ(prior.count(4), HazardTable().count(4)) << "that nobody met";
  EXPECT_EQ(pooled_prior({}, 0.0), HazardTable());
}

/// The first 3 s of the room's drive: 7 captures, 6 views that were planned.
Trajectory short_drive() {
  std::vector<TrajectoryPoint> points = straight_drive().points();
  points.resize(61);
  return Trajectory(points);
}

/// Drives through one room, which worlds of several names hold.
class Calibrating : public testing::Test {
 protected:
  Calibrating() { options.robot = coarse_robot(); }

  Calibration run(const std::vector<std::string>& worlds) {
    std::vector<CalibrationDrive> drives;
    for (const std::string& world : worlds) drives.push_back({world, scene, short_drive()});
    return calibrate(drives, options, 0.1, [&](double share) { shares.push_back(share); });
  }

  const Scene scene{room_mesh()};
  EpisodeOptions options;
  std::vector<double> shares;
};

TEST_F(Calibrating, BeginsWithWhatOtherWorldsTaught) {
  const Calibration calibration = run({"room", "hall"});
  ASSERT_EQ(calibration.drives.size(), 2U);
  const DriveCalibration& drive = calibration.drives[0];
  EXPECT_EQ(drive.from_nothing.chosen.steps, 6U);
  EXPECT_EQ(drive.from_nothing.random.steps, 10 * 7U) << "the last step's views count, too";
  EXPECT_LT(std::abs(drive.left_out.chosen.bias()), 0.25) << "the hall is the same room";
  EXPECT_NE(drive.left_out.chosen.sum_x, run({"room"}).drives[0].left_out.chosen.sum_x)
      << "there it begins with what ships";
  EXPECT_GE(drive.left_out.regret(), 0.0);
  EXPECT_LT(drive.left_out.regret(), 0.3);
  double metres = 0.0;
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) metres += drive.learnt.count(c).metres;
  EXPECT_GT(metres, 30.0);
  EXPECT_GT(shares.back(), 0.9);
}

TEST_F(Calibrating, LeavesAllDrivesThroughTheSameWorldOut) {
  const Calibration twice = run({"room", "room"});
  EXPECT_EQ(twice.drives[0].learnt, twice.drives[1].learnt);
  EXPECT_EQ(twice.drives[0].left_out.information, twice.drives[1].left_out.information);
  const Calibration once = run({"room"});
  EXPECT_EQ(twice.drives[0].left_out.information, once.drives[0].left_out.information)
      << "both began with what ships";
}

TEST(CalibrationReport, NamesDrivesAndContexts) {
  PredictionJudgement judgement{.chosen = {}, .random = {}, .chosen_gain = 8.0, .best_gain = 10.0};
  for (int i = 0; i < 6; ++i) judgement.chosen.add(i, i * i);
  const Calibration calibration{HazardTable(),
                                {{"room", counted(1.0, 20.0), judgement, judgement},
                                 {"hall", counted(1.0, 30.0), judgement, judgement}}};
  const std::string text = to_text(calibration);
  EXPECT_THAT(text, HasSubstr("room\n  from nothing: chosen views bias"));
  EXPECT_THAT(text, HasSubstr("from the other worlds"));
  EXPECT_THAT(text, HasSubstr("regret 20.0 %"));
  EXPECT_THAT(text, HasSubstr("  unknown_middle_deep: 0.131 (50 m)\n"));
  const Json json = to_json(calibration);
  EXPECT_EQ(json.at("drives").size(), 2U);
  EXPECT_EQ(json.at("drives")[1].at("left_out").at("chosen").at("steps"), 6);
  EXPECT_EQ(json.at("hazards").at("contexts").at("free_frontier").at("metres"), 2.0);
}

}  // namespace
}  // namespace nbvopt::test
