// Simulations as users run them: where the base starts, how it drives, and what is reported.
#include "sim/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nbvopt/core/error.hpp"
#include "sim/room.hpp"
#include "support/error_message.hpp"

namespace nbvopt::test {
namespace {

using testing::HasSubstr;

TEST(MakeDrive, StartsOnTheFloorUnlessToldOtherwise) {
  const Scene scene(room_mesh());
  const auto start = [&](std::vector<double> numbers) {
    DriveOptions options{.start = std::move(numbers)};
    options.exploration.duration_max_s = 0.5;
    return make_drive(scene, options).trajectory.points().front();
  };
  EXPECT_NEAR(start({0.0, -1.0, 0.5}).z_m, -0.03, 1e-6);
  EXPECT_NEAR(start({0.0, -1.0, 0.5}).yaw_rad, 0.5, 1e-12);
  EXPECT_EQ(start({0.0, -1.0, 0.2, 0.5}).z_m, 0.2);
}

TEST(MakeDrive, DrivesToGoalsInsteadOfExploring) {
  const Scene scene(room_mesh());
  const Drive drive = make_drive(scene, {.start = {0.0, -1.0, 0.0}, .goals_map_m = {{0.6, -1.0}}});
  EXPECT_EQ(drive.status, ExplorationStatus::complete);
  EXPECT_NEAR(drive.trajectory.points().back().x_m, 0.6, 0.2);
}

TEST(MakeDrive, ExploresForViewsWithTheEpisodesCamera) {
  const Scene scene(room_mesh());
  DriveOptions options{.start = {0.0, -1.0, 0.0}, .explorer = ExplorerKind::views};
  options.exploration.duration_max_s = 1.0;
  options.episode.robot = coarse_robot();
  const Drive drive = make_drive(scene, options);
  EXPECT_EQ(drive.status, ExplorationStatus::time_limit);
  EXPECT_EQ(drive.trajectory.duration_s(), 1.0);
  options.episode.motion_time_s = -1.0;
  EXPECT_THAT(message_of<InputError>([&] { make_drive(scene, options); }),
              HasSubstr("the motion time of an episode"));
}

TEST(MakeDrive, RefusesAStartThatIsNone) {
  const Scene scene(room_mesh());
  EXPECT_THAT(message_of<InputError>([&] {
                make_drive(scene, {.start = {0.0, 1.0}});
              }),
              HasSubstr("start has 2 numbers"));
  EXPECT_THAT(message_of<InputError>([&] {
                make_drive(scene, {.start = {50.0, 50.0, 0.0}});
              }),
              HasSubstr("start: there is no floor below z = 0.5 m"));
}

TEST(Simulation, ReportsItsEpisode) {
  SimulationOptions options;
  options.world = "room.world";
  options.mode = "static";
  options.episode.robot = coarse_robot();
  options.episode.motion_time_s = 2.0;
  options.episode.seed = 4;
  Simulation simulation(options);
  std::size_t observed = 0;
  const EpisodeReport report =
      simulation.run(Scene(room_mesh()), straight_drive(), [&](const Capture&) { ++observed; });
  EXPECT_EQ(report.world, "room.world");
  EXPECT_EQ(report.mode, "static");
  EXPECT_EQ(report.motion_time_s, 2.0);
  EXPECT_EQ(report.seed, 4U);
  EXPECT_EQ(report.summary.captures, 6U);
  EXPECT_EQ(observed, 6U);
  EXPECT_EQ(simulation.captures().size(), 6U);
  EXPECT_EQ(simulation.captures().back().information, report.summary.information);
  EXPECT_EQ(simulation.map().counts().certain_voxels, report.summary.voxels);
  EXPECT_EQ(simulation.map().paper_counts().voxels, report.paper_counts.voxels);
  EXPECT_GT(report.times.insert_ms, 0.0);
}

TEST(Simulation, RefusesBeforeItRuns) {
  const auto made = [](auto change) {
    SimulationOptions options;
    change(options);
    return [options] { const Simulation simulation(options); };
  };
  EXPECT_THAT(message_of<UsageError>(made([](auto& options) { options.mode = "clever"; })),
              HasSubstr("no camera mode 'clever'"));
  EXPECT_THAT(message_of<InputError>(made([](auto& options) { options.resolution_m = 0.0; })),
              HasSubstr("resolution"));
  EXPECT_THAT(
      message_of<InputError>(made([](auto& options) { options.episode.motion_time_s = -1.0; })),
      HasSubstr("motion time"));
}

}  // namespace
}  // namespace nbvopt::test
