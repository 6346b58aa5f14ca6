// Exploring for views: two small rooms, from a start to the end.
#include "nbvopt/sim/view_exploration.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "sim/box_mesh.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

/// 5 x 2.6 m: two rooms with a doorway of 1.1 m between them, and a crate; no ceiling.
TriangleMesh two_rooms() {
  TriangleMesh mesh;
  const auto wall = [&](double x_min, double y_min, double x_max, double y_max) {
    add_box(mesh, {x_min, y_min, -0.03}, {x_max, y_max, 1.5});
  };
  wall(-0.07, -0.07, 5.13, 0.03);
  wall(-0.07, 2.63, 5.13, 2.73);
  wall(-0.07, -0.07, 0.03, 2.73);
  wall(5.03, -0.07, 5.13, 2.73);
  wall(2.53, -0.07, 2.63, 1.53);
  add_box(mesh, {3.53, 0.03, -0.03}, {4.03, 0.43, 0.5});
  add_box(mesh, {-0.5, -0.5, -0.13}, {5.5, 3.2, -0.03});  // the floor
  return mesh;
}

ViewExplorationOptions coarse_options() {
  ViewExplorationOptions options;
  SensorOptions& sensor = options.episode.robot.sensor;
  sensor.gain = GainKind::expected;
  sensor.horizontal_pixels = 96;
  sensor.vertical_pixels = 72;
  sensor.horizontal_rays = 24;
  sensor.vertical_rays = 18;
  options.drive.lidar.beams = 240;
  options.drive.duration_max_s = 120.0;
  return options;
}

const Transform kStart = base_pose(1.0, 0.8, -0.03, 0.3);

std::string bytes_of(const UncertaintyMap& map) {
  const TemporaryFolder folder;
  write_map(map, folder / "map.ot", MapFormat::uncertainty_ot);
  return read_text_file(folder / "map.ot");
}

/// The distance to the nearest surface around the base, at the lidar's height.
double clearance_m(const Scene& scene, const TrajectoryPoint& point) {
  LidarOptions options;
  options.beams = 180;
  options.range_min_m = 0.0;
  const std::vector<float> ranges_m =
      SimulatedLidar(scene, options).scan(base_pose(point.x_m, point.y_m, point.z_m, 0.0));
  return *std::ranges::min_element(ranges_m);
}

/// From the start to where nothing is worth a way, once for all that look at it.
class WholeViewExploration : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_ = new Scene(two_rooms());
    exploration_ = new ViewExploration(explore_views(*scene_, kStart, coarse_options()));
  }
  static void TearDownTestSuite() {
    delete exploration_;
    delete scene_;
  }

  static const Scene* scene_;
  static const ViewExploration* exploration_;
};
const Scene* WholeViewExploration::scene_ = nullptr;
const ViewExploration* WholeViewExploration::exploration_ = nullptr;

TEST_F(WholeViewExploration, EndsByItself) {
  EXPECT_EQ(exploration_->exploration.status, ExplorationStatus::complete);
  const Trajectory& trajectory = exploration_->exploration.trajectory;
  EXPECT_GT(trajectory.duration_s(), 10.0);
  EXPECT_LT(trajectory.duration_s(), 120.0);
  EXPECT_EQ(exploration_->summary.duration_s, trajectory.duration_s());
  EXPECT_NEAR(exploration_->map.counts().information, exploration_->summary.information, 1e-6);
}

TEST_F(WholeViewExploration, SeesBothRoomsInThePlane) {
  const OccupancyGrid& grid = exploration_->exploration.grid;
  for (double y = 0.325; y < 2.4; y += 0.1) {
    for (double x = 0.325; x < 4.8; x += 0.1) {
      const bool is_in_wall = x > 2.4 && x < 2.75 && y < 1.65;
      const bool is_in_crate = x > 3.4 && x < 4.15 && y < 0.55;
      if (is_in_wall || is_in_crate) continue;
      EXPECT_EQ(grid.state(grid.cell_at({x, y})), CellState::free) << x << ", " << y;
    }
  }
}

TEST_F(WholeViewExploration, KeepsItsRadiusFromAllThatTheLidarSees) {
  const ExplorationOptions options;
  for (const TrajectoryPoint& point : exploration_->exploration.trajectory.points()) {
    ASSERT_GT(clearance_m(*scene_, point), options.base.radius_m - options.cell_m) << point.time_s;
  }
}

TEST_F(WholeViewExploration, MakesTheMapOfItsReplay) {
  UncertaintyMap replayed(0.1);
  const EpisodeSummary summary =
      run_episode(*scene_, exploration_->exploration.trajectory, *make_camera_mode("auto"),
                  coarse_options().episode, replayed, [](const Capture&) {});
  EXPECT_EQ(summary.captures, exploration_->summary.captures);
  EXPECT_EQ(summary.information, exploration_->summary.information);
  EXPECT_EQ(bytes_of(replayed), bytes_of(exploration_->map));
}

TEST(ViewExploration, IsTheSameOnAnyNumberOfThreads) {
  const Scene scene(two_rooms());
  ViewExplorationOptions options = coarse_options();
  options.drive.duration_max_s = 6.0;
  const auto points_on = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return explore_views(scene, kStart, options).exploration.trajectory.points();
  };
  const std::vector<TrajectoryPoint> on_one = points_on(1);
  EXPECT_EQ(on_one, points_on(3));
  EXPECT_EQ(on_one.back().time_s, 6.0) << "what was driven when the time is up is kept";
}

TEST(ViewExploration, RefusesWhatItCannotUse) {
  const Scene scene(two_rooms());
  ViewExplorationOptions options = coarse_options();
  options.information_min_per_s = 0.0;
  EXPECT_EQ(message_of<InputError>([&] { explore_views(scene, kStart, options); }),
            "information_min_per_s is 0, it must be positive and finite");
  EXPECT_NE(message_of<InputError>([&] {
              explore_views(scene, base_pose(2.58, 0.8, -0.03, 0.0), coarse_options());
            }).find("start"),
            std::string::npos);
}

}  // namespace
}  // namespace nbvopt::test
