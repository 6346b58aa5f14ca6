#include "nbvopt/sim/exploration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "sim/box_mesh.hpp"

namespace nbvopt {
namespace {

using testing::HasSubstr;

/// An office of 10 x 8 m seen from above: two rooms below and a hall above, with doors 1 m wide; a
/// room without a door, x from 4 to 7, y from 5 to 8; a table-high crate.
class Office : public testing::Test {
 protected:
  static TriangleMesh office() {
    TriangleMesh mesh;
    const auto wall = [&](double x_min, double y_min, double x_max, double y_max) {
      test::add_box(mesh, {x_min, y_min, 0.0}, {x_max, y_max, 2.5});
    };
    wall(0.0, 0.0, 10.0, 0.1);
    wall(0.0, 7.9, 10.0, 8.0);
    wall(0.0, 0.0, 0.1, 8.0);
    wall(9.9, 0.0, 10.0, 8.0);
    wall(0.0, 3.5, 2.0, 3.6);
    wall(3.0, 3.5, 7.0, 3.6);
    wall(8.0, 3.5, 10.0, 3.6);
    wall(5.0, 0.0, 5.1, 3.5);
    wall(4.0, 5.0, 7.0, 5.1);
    wall(4.0, 5.0, 4.1, 8.0);
    wall(6.9, 5.0, 7.0, 8.0);
    test::add_box(mesh, {2.0, 1.5, 0.0}, {3.0, 2.0, 0.7});
    test::add_box(mesh, {-1.0, -1.0, -0.1}, {11.0, 9.0, 0.0});  // the floor
    return mesh;
  }

  /// What the lidar's plane holds at a point.
  static bool is_in_closed_room(const Eigen::Vector2d& p) {
    return p.x() > 4.1 && p.x() < 6.9 && p.y() > 5.1 && p.y() < 7.9;
  }

  std::string complaint(const Transform& start, const ExplorationOptions& options) const {
    try {
      explore(scene_, start, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "explored without complaint";
  }

  Scene scene_{office()};
  Transform start_ = base_pose(1.0, 1.0, 0.0, 0.3);
};

/// The distance to the nearest surface around the base, at the lidar's height.
double clearance_m(const Scene& scene, const TrajectoryPoint& point) {
  LidarOptions options;
  options.range_min_m = 0.0;
  const std::vector<float> ranges_m =
      SimulatedLidar(scene, options).scan(base_pose(point.x_m, point.y_m, point.z_m, 0.0));
  return *std::ranges::min_element(ranges_m);
}

void expect_sound(const Scene& scene, const Trajectory& trajectory,
                  const ExplorationOptions& options) {
  const std::vector<TrajectoryPoint>& points = trajectory.points();
  constexpr double kStep_s = 0.05;
  constexpr double kRounding = 1e-6;
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  double turn_rate_rad_s = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(points[i].time_s, static_cast<double>(i) / 20.0);
    ASSERT_EQ(points[i].z_m, points[0].z_m);
    ASSERT_GT(clearance_m(scene, points[i]), options.base.radius_m - options.cell_m);
    if (i == 0) continue;
    const Eigen::Vector2d next_m_s =
        Eigen::Vector2d(points[i].x_m - points[i - 1].x_m, points[i].y_m - points[i - 1].y_m) /
        kStep_s;
    const double next_rad_s = (points[i].yaw_rad - points[i - 1].yaw_rad) / kStep_s;
    ASSERT_LE(next_m_s.norm(), options.base.speed_max_m_s + kRounding);
    ASSERT_LE(std::abs(next_rad_s), options.base.turn_rate_max_rad_s + kRounding);
    ASSERT_LE((next_m_s - velocity_m_s).norm() / kStep_s,
              options.base.acceleration_max_m_s2 + kRounding);
    ASSERT_LE(std::abs(next_rad_s - turn_rate_rad_s) / kStep_s,
              options.base.turn_acceleration_max_rad_s2 + kRounding);
    velocity_m_s = next_m_s;
    turn_rate_rad_s = next_rad_s;
  }
}

TEST_F(Office, IsKnownWhereverTheBaseCanBe) {
  const Exploration exploration = explore(scene_, start_, {});
  EXPECT_EQ(exploration.status, ExplorationStatus::complete);
  expect_sound(scene_, exploration.trajectory, {});
  const OccupancyGrid& grid = exploration.grid;
  for (double y = 0.125; y < 8.0; y += 0.1) {
    for (double x = 0.125; x < 10.0; x += 0.1) {
      if (is_in_closed_room({x, y})) {
        EXPECT_NE(grid.state(grid.cell_at({x, y})), CellState::free) << x << ", " << y;
      } else if (clearance_m(scene_, {0.0, x, y, 0.0, 0.0}) > 0.22 &&
                 !(x > 2.0 && x < 3.0 && y > 1.5 && y < 2.0)) {
        EXPECT_EQ(grid.state(grid.cell_at({x, y})), CellState::free) << x << ", " << y;
      }
    }
  }
}

TEST_F(Office, TheSameSeedGivesTheSameTrajectory) {
  const auto points = [&](std::uint64_t seed) {
    ExplorationOptions options;
    options.seed = seed;
    options.duration_max_s = 30.0;
    return explore(scene_, start_, options).trajectory.points();
  };
  EXPECT_EQ(points(7), points(7));
  EXPECT_NE(points(7), points(8));
}

TEST_F(Office, EndsWhenTheTimeIsOver) {
  ExplorationOptions options;
  options.duration_max_s = 20.03;
  const Exploration exploration = explore(scene_, start_, options);
  EXPECT_EQ(exploration.status, ExplorationStatus::time_limit);
  EXPECT_EQ(exploration.trajectory.duration_s(), 20.0);
}

TEST_F(Office, ReportsProgressAndEndsWhenThatThrows) {
  ExplorationOptions options;
  double last_s = 0.0;
  options.progress = [&](double time_s) {
    EXPECT_GT(time_s, last_s);
    last_s = time_s;
    if (time_s >= 5.0) throw Error("enough");
  };
  EXPECT_THROW(explore(scene_, start_, options), Error);
  EXPECT_EQ(last_s, 5.0);
}

TEST_F(Office, RefusesAStartThatIsNotFree) {
  const ExplorationOptions options;
  EXPECT_THAT(complaint(base_pose(5.05, 1.0, 0.0, 0.0), options),
              HasSubstr("the start (5.05, 1) is nearer to a surface"))
      << "in a wall";
  EXPECT_THAT(complaint(base_pose(0.25, 1.0, 0.0, 0.0), options),
              HasSubstr("the start (0.25, 1) is nearer to a surface"))
      << "at a wall";
  EXPECT_THAT(complaint(base_pose(2.5, 1.75, 0.0, 0.0), options),
              HasSubstr("the start (2.5, 1.75) is inside a wall or a piece of furniture"));
  Transform leaning = start_;
  leaning.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  EXPECT_THAT(complaint(leaning, options), HasSubstr("leans"));
  Transform nowhere = start_;
  nowhere.translation().x() = std::nan("");
  EXPECT_THAT(complaint(nowhere, options), HasSubstr("not finite"));
}

TEST_F(Office, NamesABadOption) {
  ExplorationOptions options;
  options.base.speed_max_m_s = 0.0;
  EXPECT_THAT(complaint(start_, options), HasSubstr("base.speed_max_m_s is 0"));
  options = {};
  options.cell_m = -1.0;
  EXPECT_THAT(complaint(start_, options), HasSubstr("cell_m is -1"));
  options = {};
  options.duration_max_s = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint(start_, options), HasSubstr("duration_max_s is inf"));
  options = {};
  options.lidar.beams = 0;
  EXPECT_THAT(complaint(start_, options), HasSubstr("lidar.beams is 0"));
  options = {};
  options.base.radius_m = 1e6;
  EXPECT_THAT(complaint(start_, options), HasSubstr("base.radius_m is 1e+06"));
  options = {};
  options.mapping_range_m = 101.0;
  EXPECT_THAT(complaint(start_, options), HasSubstr("mapping_range_m is 101"));
  EXPECT_THAT(complaint(base_pose(1e9, 0.0, 0.0, 0.0), {}), HasSubstr("10 km"));
}

TEST_F(Office, DrivesToGoalsInTurn) {
  const std::vector<Eigen::Vector2d> goals{{8.5, 6.5}, {4.2, 1.2}};
  const Exploration exploration = drive_to(scene_, start_, goals, {});
  EXPECT_EQ(exploration.status, ExplorationStatus::complete);
  expect_sound(scene_, exploration.trajectory, {});
  std::size_t reached = 0;
  for (const TrajectoryPoint& point : exploration.trajectory.points()) {
    if (reached == goals.size()) break;
    if ((Eigen::Vector2d(point.x_m, point.y_m) - goals[reached]).norm() < 0.05) ++reached;
  }
  EXPECT_EQ(reached, goals.size());
  const TrajectoryPoint& last = exploration.trajectory.points().back();
  EXPECT_LT((Eigen::Vector2d(last.x_m, last.y_m) - goals.back()).norm(), 0.1);
}

TEST_F(Office, NamesAGoalThatCannotBeReached) {
  const auto drive_complaint = [&](const std::vector<Eigen::Vector2d>& goals) -> std::string {
    try {
      drive_to(scene_, start_, goals, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "drove without complaint";
  };
  EXPECT_THAT(drive_complaint({{1.0, 2.0}, {5.05, 1.0}}),
              HasSubstr("goal 2 (5.05, 1) cannot be reached"))
      << "in a wall";
  EXPECT_THAT(drive_complaint({{1.0, 0.2}}), HasSubstr("goal 1 (1, 0.2) cannot be reached"))
      << "too near to one";
  EXPECT_THAT(drive_complaint({{5.5, 6.5}}), HasSubstr("goal 1 (5.5, 6.5) cannot be reached"))
      << "in the room without a door";
  EXPECT_THAT(drive_complaint({{std::nan(""), 0.0}}), HasSubstr("goal 1 is not finite"));
}

TEST_F(Office, StaysWhereNoGoalIsGiven) {
  const Exploration exploration = drive_to(scene_, start_, {}, {});
  EXPECT_EQ(exploration.status, ExplorationStatus::complete);
  EXPECT_EQ(exploration.trajectory.points().size(), 1U);
}

/// Two rooms, x from 0 to 3 and 3.1 to 6, joined by a gap.
Scene rooms_with_gap(double width_m) {
  TriangleMesh mesh;
  const auto wall = [&](double x_min, double y_min, double x_max, double y_max) {
    test::add_box(mesh, {x_min, y_min, 0.0}, {x_max, y_max, 2.5});
  };
  wall(0.0, 0.0, 6.0, 0.1);
  wall(0.0, 3.0, 6.0, 3.1);
  wall(-0.1, 0.0, 0.0, 3.1);
  wall(6.0, 0.0, 6.1, 3.1);
  wall(3.0, 0.1, 3.1, 1.5 - 0.5 * width_m);
  wall(3.0, 1.5 + 0.5 * width_m, 3.1, 3.0);
  return Scene(mesh);
}

TEST(Exploration, DoesNotWaitForEverAtAGapThatTheBaseDoesNotFitThrough) {
  const Scene scene = rooms_with_gap(0.4);
  const Exploration exploration = explore(scene, base_pose(1.0, 1.0, 0.0, 0.0), {});
  EXPECT_EQ(exploration.status, ExplorationStatus::complete);
  EXPECT_LT(exploration.trajectory.duration_s(), 300.0);
  for (const TrajectoryPoint& point : exploration.trajectory.points()) EXPECT_LT(point.x_m, 3.0);
  expect_sound(scene, exploration.trajectory, {});
}

TEST(Exploration, FitsThroughANarrowDoor) {
  const Scene scene = rooms_with_gap(0.65);
  const std::vector<Eigen::Vector2d> goals{{5.0, 0.5}};
  const Exploration exploration = drive_to(scene, base_pose(1.0, 2.5, 0.0, 0.0), goals, {});
  EXPECT_GT(exploration.trajectory.points().back().x_m, 4.9);
  expect_sound(scene, exploration.trajectory, {});
}

}  // namespace
}  // namespace nbvopt
