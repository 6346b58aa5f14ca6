// Episodes among people: who meets whom, and what they leave in the map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/sim/episode.hpp"
#include "sim/people/bystanders.hpp"
#include "sim/people/ghosts.hpp"
#include "sim/room.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

using testing::HasSubstr;

/// Stands two metres before the robot of standing_drive(), then goes away to the side.
People passer_by() {
  const ScriptedWalk walk{.waypoints = {{0.0, {0.0, 0.0, 1.0}, kPi / 2},
                                        {4.0, {0.0, 0.0, 1.0}, kPi / 2},
                                        {6.0, {0.0, 2.5, 1.0}, kPi / 2}},
                          .is_loop = false};
  return {.persons = {{.name = "walker", .position_map_m = {0.0, 0.0, 1.0}, .walk = walk}}};
}

/// At (-2, 0) for ten seconds.
Trajectory standing_drive() {
  return Trajectory({{.time_s = 0.0, .x_m = -2.0}, {.time_s = 10.0, .x_m = -2.0}});
}

struct PeopledEpisode {
  UncertaintyMap map{0.1};
  std::vector<Capture> captures;
  EpisodeSummary summary;
};

PeopledEpisode run_among(const People& people, const std::string& mode, const Trajectory& drive) {
  const Scene scene(room_mesh());
  EpisodeOptions options;
  options.robot = coarse_robot();
  options.people = people;
  PeopledEpisode run;
  run.summary = run_episode(scene, drive, *make_camera_mode(mode), options, run.map,
                            [&](const Capture& capture) { run.captures.push_back(capture); });
  return run;
}

/// Of the whole map, one voxel after the other.
std::uint64_t ghosts_counted_anew(const UncertaintyMap& map) {
  const Scene scene(room_mesh());
  return GhostCounter(scene, map).ghosts();
}

TEST(EpisodeWithPeople, LeavesGhostsUntilTheyAreSeenThrough) {
  const PeopledEpisode episode = run_among(passer_by(), "static", standing_drive());
  ASSERT_EQ(episode.captures.size(), 21U);
  const std::uint64_t standing = *episode.captures[8].ghosts;
  EXPECT_GT(standing, 50U);
  EXPECT_EQ(*episode.captures[20].ghosts, 0U) << "eight captures see through where he stood";
  EXPECT_EQ(episode.summary.ghosts, episode.captures[20].ghosts);
  EXPECT_EQ(ghosts_counted_anew(episode.map), 0U);
  // What is free knows nothing of what he was seen with.
  const Lattice& lattice = episode.map.lattice();
  for (double z_m = 0.35; z_m < 0.7; z_m += 0.1) {
    const VoxelRecord voxel = episode.map.at(lattice.key({-0.25, 0.01, z_m}));
    EXPECT_EQ(voxel.state, VoxelState::free) << z_m;
    EXPECT_EQ(voxel.uncertainty, 1.0F) << z_m;
  }
}

TEST(EpisodeWithPeople, CountsWhatStays) {
  People people = passer_by();
  people.persons[0].walk = std::monostate();
  const PeopledEpisode episode = run_among(people, "static", standing_drive());
  EXPECT_GT(*episode.summary.ghosts, 50U);
  EXPECT_EQ(ghosts_counted_anew(episode.map), *episode.summary.ghosts);
  const PeopledEpisode alone = run_among({}, "static", standing_drive());
  EXPECT_FALSE(alone.summary.ghosts.has_value());
  EXPECT_FALSE(alone.captures[0].ghosts.has_value());
  EXPECT_EQ(ghosts_counted_anew(alone.map), 0U);
}

/// A ghost that is seen from near and then through, and a wall that is later found there.
TEST(EpisodeWithPeople, ForgetsHowWellAGhostWasSeen) {
  const SensorOptions sensor;
  UncertaintyMap map(0.1);
  const auto insert = [&](double distance_m) {
    Scan scan;
    scan.points_m = {{0.0F, 0.0F, static_cast<float>(distance_m)}};
    insert_scan(map, scan, Transform(Eigen::Translation3d(0.05, 0.05, 0.05)), sensor);
  };
  const VoxelKey voxel = map.lattice().key({0.05, 0.05, 1.05});
  insert(1.0);
  const float near_u = map.at(voxel).uncertainty;
  for (int i = 0; i < 3; ++i) insert(2.0);
  ASSERT_EQ(map.at(voxel).state, VoxelState::free);
  for (int i = 0; i < 2; ++i) {  // the same voxel from another place, three metres away
    Scan scan;
    scan.points_m = {{0.0F, 0.0F, 3.0F}};
    insert_scan(map, scan, Transform(Eigen::Translation3d(0.05, 0.05, -1.95)), sensor);
  }
  ASSERT_EQ(map.at(voxel).state, VoxelState::occupied);
  EXPECT_GT(map.at(voxel).uncertainty, near_u + 0.1F);
}

TEST(EpisodeWithPeople, MeetsTheSameInAllModesAndForAnyNumberOfThreads) {
  const Scene scene(room_mesh());
  const auto bodies_at = [&](double step_s) {
    People people = passer_by();
    people.persons.push_back(
        {.name = "other", .position_map_m = {-1.0, -2.0, 1.0}, .walk = TargetWalk{}});
    Bystanders bystanders(scene, people, 1);
    const Trajectory drive = straight_drive();
    for (double time_s = 0.0; time_s < 5.0 + 1e-9; time_s += step_s) {
      bystanders.move_to(time_s, [&](double at_s) {
        return Eigen::Vector3d(drive.T_map_base(at_s).translation());
      });
    }
    std::vector<Eigen::Vector3f> directions;
    for (int i = 0; i < 360; ++i) {
      const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / 360.0F;
      directions.emplace_back(std::cos(angle), std::sin(angle), 0.0F);
    }
    std::vector<float> distances(directions.size(), kInfinity);
    bystanders.bodies().shorten({0.0, 0.0, 1.0}, directions, 10.0F, distances);
    return distances;
  };
  EXPECT_EQ(bodies_at(0.5), bodies_at(0.25));

  const TemporaryFolder folder;
  const auto map_bytes = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const PeopledEpisode episode = run_among(passer_by(), "grid", straight_drive());
    write_map(episode.map, folder / "map.ot", MapFormat::uncertainty_ot);
    return read_text_file(folder / "map.ot");
  };
  EXPECT_EQ(map_bytes(1), map_bytes(4));
}

TEST(EpisodeWithPeople, RefusesPeopleInWallsAndAboveNothing) {
  const auto refusal = [](const Eigen::Vector3d& position_map_m) {
    People people = passer_by();
    people.persons[0].walk = std::monostate();
    people.persons[0].position_map_m = position_map_m;
    return message_of<InputError>([&] { run_among(people, "static", standing_drive()); });
  };
  EXPECT_EQ(refusal({1.45, -0.2, 1.0}),
            "actor 'walker' stands in or at a wall or a piece of furniture at (1.45, -0.2): move "
            "it in the world's file, or leave people out");
  EXPECT_THAT(refusal({1.77, -0.2, 1.0}), HasSubstr("stands in or at a wall"));  // in the pillar
  EXPECT_THAT(refusal({30.0, 0.0, 1.0}), HasSubstr("'walker' has no floor below at (30, 0)"));
  EXPECT_EQ(refusal({0.0, 0.0, 0.0}), "") << "a pose on the floor";
}

}  // namespace
}  // namespace nbvopt::test
