#include "sim/episode_output.hpp"

#include <gmock/gmock.h>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using testing::HasSubstr;
using testing::Not;

EpisodeReport made_episode() {
  EpisodeReport report;
  report.world = "room.world";
  report.mode = "grid-3";
  report.motion_time_s = 0.2;
  report.seed = 7;
  report.summary = {.duration_s = 1.0 / 3.0,
                    .captures = 5,
                    .voxels = 12'345,
                    .information = 0.1 + 0.2,
                    .prediction = {2, 3.5, 4, 5, 10.25, 7}};
  report.summary.growth.add(0.0, 0.1);
  report.summary.growth.add(0.2, 0.1 + 0.2);
  report.paper_counts = {.voxels = 20'000, .information = 1e-9};
  report.times = {1.5, 2.5, 3.5, 4.5};
  report.elapsed_ms = 99.0;
  return report;
}

TEST(EpisodeReport, IsTheSameAfterItsWayThroughText) {
  const Json json = to_json(made_episode());
  const EpisodeReport read = episode_report_of(Json::parse(json.dump()));
  EXPECT_EQ(to_json(read), json);
  EXPECT_EQ(read.summary.information, 0.1 + 0.2) << "to the bit";
  EXPECT_EQ(read.summary.prediction.sum_xy, 7.0);
  EXPECT_EQ(read.paper_counts.voxels, 20'000U);
  EXPECT_EQ(read.times.plan_ms, 4.5);
  EXPECT_EQ(read.summary.growth.points(), made_episode().summary.growth.points());
}

TEST(EpisodeReport, TellsOfGhostsWhereTheyWereCounted) {
  EpisodeReport report = made_episode();
  EXPECT_TRUE(to_json(report).at("ghosts").is_null());
  EXPECT_THAT(to_text(report), Not(HasSubstr("ghosts")));
  report.summary.ghosts = 12;
  EXPECT_EQ(episode_report_of(to_json(report)).summary.ghosts, 12U);
  EXPECT_THAT(to_text(report), HasSubstr("ghosts: 12 occupied voxels"));
}

TEST(EpisodeReport, ToleratesThatNothingWasPredicted) {
  EpisodeReport still = made_episode();
  still.summary.prediction = {};
  const Json json = to_json(still);
  EXPECT_TRUE(json.at("prediction").at("correlation").is_null());
  EXPECT_EQ(to_json(episode_report_of(json)), json);
}

TEST(EpisodeReport, KeepsWhatPosesAndMapsWereWorth) {
  EpisodeReport slam = made_episode();
  EXPECT_TRUE(to_json(slam).at("localisation").is_null());
  EXPECT_TRUE(to_json(slam).at("map_score").is_null());
  slam.pose_source = PoseSource::slam;
  slam.summary.localisation = {
      .captures = {0.1, 0.2, 0.05}, .scans = {0.01, 0.02, 0.005}, .scan_count = 7, .scan_ms = 12.5};
  slam.summary.map_score = {.occupied_voxels = 99,
                            .precision = 0.9,
                            .recall = 0.8,
                            .true_information = 1.0 / 3.0,
                            .shared_information = 0.25};
  const Json json = to_json(slam);
  EXPECT_EQ(json.at("pose_source"), "slam");
  EXPECT_EQ(json.at("map_score").at("recall"), 0.8);
  EXPECT_EQ(json.at("times_ms").at("scan"), 12.5);
  EXPECT_EQ(to_json(episode_report_of(json)), json);
  EXPECT_THAT(to_text(slam), HasSubstr("pose by slam: off by 0.100 m on average, 0.200 m at most"));
  EXPECT_THAT(to_text(slam), HasSubstr("90.0 % of the occupied voxels"));
  Json unknown = json;
  unknown["pose_source"] = "gps";
  EXPECT_THAT(test::message_of<InputError>([&] { episode_report_of(unknown); }),
              HasSubstr("'gps'"));
}

TEST(EpisodeReport, TellsHowFastTheMapGrew) {
  const Json json = to_json(made_episode());
  EXPECT_NEAR(json.at("mean_information").get<double>(), (0.2 * 0.1 + (1.0 / 3 - 0.2) * 0.3) * 3,
              1e-12);
  EXPECT_THAT(to_text(made_episode()), HasSubstr("50 % after 0.2 s"));
}

TEST(EpisodeReport, MissesEveryFigure) {
  for (const char* key :
       {"world", "mode", "motion_time_s", "seed", "duration_s", "captures", "voxels", "information",
        "ghosts", "growth", "voxels_as_paper_counts", "information_as_paper_counts", "pose_source",
        "localisation", "map_score", "prediction", "times_ms"}) {
    Json json = to_json(made_episode());
    json.erase(key);
    EXPECT_THROW(episode_report_of(json), Json::exception) << key;
  }
}

TEST(DriveReport, IsTheSameAfterItsWay) {
  for (const auto status : {ExplorationStatus::complete, ExplorationStatus::open_ground,
                            ExplorationStatus::time_limit}) {
    const Json json = to_json(DriveReport{.world = "room.world",
                                          .start = {1.0, 0.1, 1.57},
                                          .status = status,
                                          .duration_s = 26.2,
                                          .length_m = 1.0 / 3.0,
                                          .seed = 3});
    EXPECT_EQ(to_json(drive_report_of(json)), json);
    EXPECT_EQ(drive_report_of(json).status, status);
  }
}

TEST(DriveReport, RefusesAStatusThatThereIsNot) {
  Json json = to_json(DriveReport{});
  json["status"] = "lost";
  EXPECT_THAT(test::message_of<InputError>([&] { drive_report_of(json); }), HasSubstr("'lost'"));
}

}  // namespace
}  // namespace nbvopt
