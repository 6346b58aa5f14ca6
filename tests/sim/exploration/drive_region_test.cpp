// Explorations that keep to a region, or to what there is to see.
#include "sim/exploration/drive_region.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "sim/box_mesh.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::message_of;
using testing::HasSubstr;

/// A hut of 4 x 4 m on a wide plain, its door, 1 m wide, open to the east.
class OpenDoor : public testing::Test {
 protected:
  static TriangleMesh hut() {
    TriangleMesh mesh;
    test::add_box(mesh, {0, 0, 0}, {4, 0.1, 2.5});
    test::add_box(mesh, {0, 3.9, 0}, {4, 4, 2.5});
    test::add_box(mesh, {0, 0, 0}, {0.1, 4, 2.5});
    test::add_box(mesh, {3.9, 0, 0}, {4, 1.5, 2.5});
    test::add_box(mesh, {3.9, 2.5, 0}, {4, 4, 2.5});
    test::add_box(mesh, {-100, -100, -0.1}, {100, 100, 0});
    return mesh;
  }

  static Eigen::AlignedBox2d box_of_drive(const Exploration& exploration) {
    Eigen::AlignedBox2d box;
    for (const TrajectoryPoint& point : exploration.trajectory.points()) {
      box.extend(Eigen::Vector2d(point.x_m, point.y_m));
    }
    return box;
  }

  Exploration run() const { return explore(scene_, base_pose(2, 2, 0, 0), options_); }

  Scene scene_{hut()};
  ExplorationOptions options_;
};

TEST_F(OpenDoor, EndsWhereOnlyOpenGroundIsLeft) {
  options_.world_map_m = {Eigen::Vector2d(0, 0), Eigen::Vector2d(4, 4)};
  const Exploration exploration = run();
  EXPECT_EQ(exploration.status, ExplorationStatus::open_ground);
  const Eigen::AlignedBox2d drive = box_of_drive(exploration);
  EXPECT_GT(drive.max().x(), 4.0);  // it did look outside
  EXPECT_LT(drive.max().x(), 4.0 + options_.mapping_range_m + 1.0);
  EXPECT_GT(drive.min().y(), -options_.mapping_range_m - 1.0);
}

TEST_F(OpenDoor, GoesOnWhereItIsNotToldWhatTheWorldShows) {
  options_.duration_max_s = 120.0;
  EXPECT_EQ(run().status, ExplorationStatus::time_limit);
}

TEST_F(OpenDoor, StaysInItsRegion) {
  options_.world_map_m = {Eigen::Vector2d(0, 0), Eigen::Vector2d(4, 4)};
  options_.region_map_m = {{0, 0}, {3.5, 0}, {3.5, 4}, {0, 4}};
  const Exploration exploration = run();
  EXPECT_EQ(exploration.status, ExplorationStatus::complete);
  EXPECT_LT(box_of_drive(exploration).max().x(), 3.9);
}

TEST_F(OpenDoor, RefusesStartsAndGoalsOutsideOfTheRegion) {
  const auto complaint = [&] { return message_of<InputError>([&] { run(); }); };
  options_.region_map_m = {{0, 0}, {1, 0}, {1, 4}, {0, 4}};
  EXPECT_THAT(complaint(), HasSubstr("the start (2, 2) lies outside of the region"));
  options_.region_map_m = {{0, 0}, {3, 0}};
  EXPECT_THAT(complaint(), HasSubstr("has 2 corners"));
  options_.region_map_m = {{0, 0}, {3, 0}, {std::numeric_limits<double>::quiet_NaN(), 0}};
  EXPECT_THAT(complaint(), HasSubstr("is not finite"));
  options_.region_map_m = {{0, 0}, {3, 0}, {3, 4}, {0, 4}};
  const Eigen::Vector2d goals[] = {{1.0, 1.0}, {3.5, 2.0}};
  EXPECT_THAT(
      message_of<InputError>([&] { drive_to(scene_, base_pose(2, 2, 0, 0), goals, options_); }),
      HasSubstr("goal 2 (3.5, 2) lies outside of the region"));
}

TEST(DriveRegion, MayHaveABay) {
  ExplorationOptions options;
  options.region_map_m = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  const DriveRegion region(options);
  EXPECT_TRUE(region.contains({0.5, 2.0}));
  EXPECT_FALSE(region.contains({2.0, 2.0}));
  EXPECT_TRUE(region.contains({3.5, 2.0}));
  EXPECT_FALSE(region.contains({5.0, 2.0}));
}

}  // namespace
}  // namespace nbvopt
