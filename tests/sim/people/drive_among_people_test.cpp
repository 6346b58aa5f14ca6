// Drives among people whom the lidar sees, or does not.
#include <gtest/gtest.h>

#include "nbvopt/sim/exploration.hpp"
#include "sim/plane_scan.hpp"
#include "sim/room.hpp"

namespace nbvopt::test {
namespace {

People one_who_stands() { return {.persons = {{.name = "a", .position_map_m = {0.0, 0.0, 1.0}}}}; }

TEST(DriveAmongPeople, EndsBeamsAtPeopleWithoutAHit) {
  const Scene scene(room_mesh());
  const SimulatedLidar lidar(scene, {});
  PeopleScene people(1);
  const BodyPose body{.feet_map_m = {0.0, 0.0, 0.0}};
  people.place({&body, 1});
  const Transform T_world_base = base_pose(-2.0, 0.0, 0.0, 0.3);
  const std::vector<PlaneBeam> blind = plane_scan(lidar, T_world_base, 9.0);
  std::vector<PlaneBeam> beams = blind;
  end_at_people(people, lidar, T_world_base, beams);
  ASSERT_EQ(beams.size(), blind.size());
  int shortened = 0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].end_base_m == blind[i].end_base_m) {
      EXPECT_EQ(beams[i].is_hit, blind[i].is_hit);
      continue;
    }
    ++shortened;
    EXPECT_FALSE(beams[i].is_hit);
    const Eigen::Vector3d end_base_m(beams[i].end_base_m.x(), beams[i].end_base_m.y(), 0.0);
    EXPECT_LT((T_world_base * end_base_m).norm(), 0.25);
  }
  EXPECT_GT(shortened, 20);
}

TEST(DriveAmongPeople, LooksAgainWhereSomebodyStood) {
  const Scene scene(room_mesh());
  const Transform start = base_pose(-2.0, 0.0, 0.0, 0.0);
  ExplorationOptions options;
  options.mapping_range_m = 9.0;
  const Exploration blind = explore(scene, start, options);
  options.people = one_who_stands();
  const Exploration seeing = explore(scene, start, options);
  EXPECT_EQ(seeing.status, ExplorationStatus::complete);
  EXPECT_NE(seeing.trajectory.points(), blind.trajectory.points());
  EXPECT_NE(seeing.grid.state(seeing.grid.cell_at({-0.26, 0.0})), CellState::occupied);
}

}  // namespace
}  // namespace nbvopt::test
