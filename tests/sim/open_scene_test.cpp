// Where a robot sees the open: through a wide door, a roof with a hole, and outside.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "sim/room.hpp"

namespace nbvopt::test {
namespace {

/// A room of 8 x 6 m with a door 2 m wide towards a yard, and no roof in one corner.
TriangleMesh open_scene() {
  TriangleMesh mesh;
  add_box(mesh, {-12.0, -12.0, -0.13}, {20.0, 12.0, -0.03});  // ground
  add_box(mesh, {-4.13, -3.03, -0.03}, {-4.03, 3.03, 2.53});  // walls
  add_box(mesh, {-4.03, -3.13, -0.03}, {4.03, -3.03, 2.53});
  add_box(mesh, {-4.03, 3.03, -0.03}, {4.03, 3.13, 2.53});
  add_box(mesh, {4.03, -3.03, -0.03}, {4.13, -1.03, 2.53});  // beside the door
  add_box(mesh, {4.03, 1.03, -0.03}, {4.13, 3.03, 2.53});
  add_box(mesh, {-4.13, 0.03, 2.53}, {4.13, 3.13, 2.63});  // roof, but for a corner
  add_box(mesh, {0.03, -3.13, 2.53}, {4.13, 0.03, 2.63});
  add_box(mesh, {-2.52, 1.03, -0.03}, {-1.04, 2.03, 0.73});  // furniture
  add_box(mesh, {6.52, 1.53, -0.03}, {7.04, 3.03, 0.93});    // in the yard
  add_box(mesh, {8.02, -2.53, -0.03}, {9.54, -2.03, 1.13});
  return mesh;
}

/// Half of it inside, half outside.
Trajectory drive_out() {
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i <= 240; ++i) {
    points.push_back({.time_s = i / 6.0, .x_m = -2.0 + i / 24.0, .yaw_rad = 0.0});
  }
  return Trajectory(points);
}

struct Drive {
  EpisodeSummary summary;
  double sky = 0.0;  ///< share of the planning rays that rise and meet nothing
};

Drive drive(GainKind gain) {
  const Scene scene(open_scene());
  EpisodeOptions options;
  options.robot = coarse_robot();
  options.robot.sensor.gain = gain;
  const Mast mast(options.robot.mast);
  const DepthCamera camera(options.robot.sensor);
  const SimulatedCamera eye(scene, options.robot.sensor, 0.0, 1);
  Drive drive;
  std::size_t views = 0;
  UncertaintyMap map(0.1);
  drive.summary = run_episode(
      scene, drive_out(), *make_camera_mode("auto"), options, map, [&](const Capture& capture) {
        const Transform T = capture.T_map_base * mast.T_base_sensor(capture.joints);
        const std::vector<float> distances_m = eye.planning_distances_m(T);
        std::size_t sky = 0;
        for (std::size_t i = 0; i < distances_m.size(); ++i) {
          const bool rises = (T.linear() * camera.rays().direction(i)).z() > 0.0;
          if (rises && !std::isfinite(distances_m[i])) ++sky;
        }
        drive.sky += static_cast<double>(sky) / static_cast<double>(distances_m.size());
        ++views;
      });
  drive.sky /= static_cast<double>(views);
  std::cout << to_string(gain) << ": " << 100.0 * drive.sky << " % of the rays into the sky, bias "
            << drive.summary.prediction.bias() << ", correlation "
            << drive.summary.prediction.correlation() << ", information "
            << drive.summary.information << '\n';
  return drive;
}

TEST(OpenScene, IsNotStaredAtWithAnExpectedGain) {
  const Drive positive = drive(GainKind::positive);
  const Drive expected = drive(GainKind::expected);
  EXPECT_GT(positive.sky, 0.3) << "else the scene shows nothing";
  EXPECT_LT(expected.sky, 0.7 * positive.sky);
  EXPECT_GT(expected.summary.information, 1.1 * positive.summary.information);
  EXPECT_LT(std::abs(expected.summary.prediction.bias()), 0.25);
  EXPECT_GT(positive.summary.prediction.bias(), 1.0);
}

}  // namespace
}  // namespace nbvopt::test
