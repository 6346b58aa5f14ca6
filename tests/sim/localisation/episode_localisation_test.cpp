// Episodes whose base does not know exactly where it is.
#include <gtest/gtest.h>

#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/sim/episode.hpp"
#include "sim/room.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

/// An episode and all that it left behind.
struct LocalisedEpisode {
  UncertaintyMap map{0.1};
  std::vector<Capture> captures;
  EpisodeSummary summary;
};

EpisodeOptions options_with(PoseSource source) {
  EpisodeOptions options;
  options.robot = coarse_robot();
  options.localisation.source = source;
  options.localisation.lidar.beams = 180;
  options.scores_map = true;
  return options;
}

LocalisedEpisode run_localised(const std::string& mode, const EpisodeOptions& options) {
  const Scene scene(room_mesh());
  LocalisedEpisode run;
  run.summary = run_episode(scene, straight_drive(), *make_camera_mode(mode), options, run.map,
                            [&](const Capture& capture) { run.captures.push_back(capture); });
  return run;
}

std::string bytes_of(const UncertaintyMap& map) {
  const TemporaryFolder folder;
  write_map(map, folder / "map.ot", MapFormat::uncertainty_ot);
  return read_text_file(folder / "map.ot");
}

TEST(LocalisedEpisode, IsWhatItWasWhereThePoseIsKnown) {
  EpisodeOptions plain;
  plain.robot = coarse_robot();
  const LocalisedEpisode before = run_localised("grid", plain);
  EpisodeOptions scored = options_with(PoseSource::truth);
  scored.localisation.odometry_noise = 3.0;
  const LocalisedEpisode after = run_localised("grid", scored);
  EXPECT_EQ(bytes_of(before.map), bytes_of(after.map));
  EXPECT_FALSE(before.summary.map_score.has_value());
  EXPECT_FALSE(after.summary.localisation.has_value());
  ASSERT_TRUE(after.summary.map_score.has_value());
  EXPECT_EQ(after.summary.map_score->precision, 1.0);
  EXPECT_EQ(after.summary.map_score->recall, 1.0);
  EXPECT_NEAR(after.summary.map_score->true_information, after.summary.information,
              1e-6 * after.summary.information);
  EXPECT_EQ(after.summary.map_score->shared_information, after.summary.map_score->true_information);
  for (const Capture& capture : after.captures) {
    EXPECT_EQ(capture.T_map_base.matrix(), capture.T_world_base.matrix());
  }
}

TEST(LocalisedEpisode, MapsWhatItSeesWhereItBelievesToBe) {
  const LocalisedEpisode odom = run_localised("static", options_with(PoseSource::odom));
  const LocalisedEpisode slam = run_localised("static", options_with(PoseSource::slam));
  ASSERT_TRUE(odom.summary.map_score && slam.summary.map_score);
  ASSERT_TRUE(odom.summary.localisation && slam.summary.localisation);
  EXPECT_LT(slam.summary.localisation->captures.mean_m, odom.summary.localisation->captures.mean_m);
  EXPECT_LT(odom.summary.map_score->precision, slam.summary.map_score->precision);
  EXPECT_LT(odom.summary.map_score->recall, slam.summary.map_score->recall);
  EXPECT_LT(odom.summary.map_score->true_information, odom.summary.information);
  const Capture& last = odom.captures.back();
  EXPECT_NE(last.T_map_base.matrix(), last.T_world_base.matrix());
  EXPECT_EQ(last.T_world_base.matrix(), straight_drive().T_map_base(last.time_s).matrix());
}

/// Where the wheels are exact, odometry is the truth but for rounding.
TEST(LocalisedEpisode, IsTrueWithExactWheels) {
  EpisodeOptions options = options_with(PoseSource::odom);
  options.localisation.odometry_noise = 0.0;
  const LocalisedEpisode odom = run_localised("auto", options);
  const LocalisedEpisode truth = run_localised("auto", options_with(PoseSource::truth));
  EXPECT_NEAR(odom.summary.information, truth.summary.information,
              0.01 * truth.summary.information);
  EXPECT_GT(odom.summary.map_score->recall, 0.999);
  for (std::size_t i = 1; i < odom.captures.size(); ++i) {
    EXPECT_NEAR(odom.captures[i].joints.pan_rad, truth.captures[i].joints.pan_rad, 0.05);
  }
}

TEST(LocalisedEpisode, LeavesTheMapAloneWhenItCannotBe) {
  const Scene scene(room_mesh());
  EpisodeOptions options = options_with(PoseSource::slam);
  options.localisation.lidar_range_m = 0.3;
  UncertaintyMap map(0.1);
  const auto run = [&] {
    run_episode(scene, straight_drive(), *make_camera_mode("static"), options, map,
                [](const Capture&) {});
  };
  EXPECT_NE(message_of<InputError>(run), "");
  EXPECT_FALSE(map.has_occupied());
  options.localisation = {.source = PoseSource::odom, .odometry_noise = -1.0};
  EXPECT_EQ(message_of<InputError>(run), "odometry_noise is -1, it must be 0 or more and finite");
}

}  // namespace
}  // namespace nbvopt::test
