#include <gtest/gtest.h>

#include <algorithm>

#include "nbvopt/core/error.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sim/volume_exploration.hpp"
#include "sim/box_mesh.hpp"

namespace nbvopt {
namespace {

/// A closed room of 3 x 2.5 m with a cupboard in a corner.
TriangleMesh small_room() {
  TriangleMesh mesh;
  test::add_box(mesh, {-0.02, -0.02, -0.02}, {3.02, 2.52, 2.02});
  test::add_box(mesh, {2.43, 1.83, -0.02}, {3.02, 2.52, 1.5});
  return mesh;
}

class VolumeExplorerTest : public testing::Test {
 protected:
  Exploration explore(VolumeExplorer explorer, const ExplorationOptions& options) const {
    const Transform T_base_sensor = Mast(MastOptions{}).T_base_sensor({.height_m = 0.4});
    return explore_volume(scene_, base_pose(0.8, 0.8, 0.0, 0.3), T_base_sensor, explorer, options);
  }

  Scene scene_{small_room()};
};

TEST_F(VolumeExplorerTest, EndsByItselfInASmallRoom) {
  ExplorationOptions options;
  options.duration_max_s = 600.0;
  const Exploration made = explore(VolumeExplorer::bai2016, options);
  EXPECT_EQ(made.status, ExplorationStatus::complete);
  EXPECT_LT(made.trajectory.duration_s(), 300.0);
  // It has turned around once.
  EXPECT_GT(made.trajectory.points().back().yaw_rad, 6.0);
  EXPECT_EQ(explore(VolumeExplorer::bai2016, options).trajectory.points(),
            made.trajectory.points());
}

TEST_F(VolumeExplorerTest, GoesOnWhereAnExplorationOfThePlaneEnds) {
  ExplorationOptions options;
  options.duration_max_s = 600.0;
  const Transform T_base_sensor = Mast(MastOptions{}).T_base_sensor({.height_m = 0.4});
  const Transform start = base_pose(0.8, 0.8, 0.0, 0.3);
  const std::vector<TrajectoryPoint> alone =
      nbvopt::explore(scene_, start, options).trajectory.points();
  const Exploration made =
      explore_volume_after_plane(scene_, start, T_base_sensor, VolumeExplorer::bai2016, options);
  const std::vector<TrajectoryPoint>& both = made.trajectory.points();
  EXPECT_EQ(made.status, ExplorationStatus::complete);
  ASSERT_GT(both.size(), alone.size());
  EXPECT_TRUE(std::equal(alone.begin(), alone.end(), both.begin()));
  // There it turns around once.
  const auto farthest = std::ranges::max_element(both, {}, &TrajectoryPoint::yaw_rad);
  EXPECT_GT(farthest->yaw_rad - alone.back().yaw_rad, 6.0);
}

TEST_F(VolumeExplorerTest, EndsInTime) {
  ExplorationOptions options;
  options.duration_max_s = 9.0;
  const Exploration made = explore(VolumeExplorer::tekniker, options);
  EXPECT_NEAR(made.trajectory.duration_s(), 9.0, 0.1);
}

}  // namespace
}  // namespace nbvopt
