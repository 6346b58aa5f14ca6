// The world that ships is the one that its generator makes, and the office that the shipped map
// knows a part of.
#include "office_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/text_file.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "nbvopt/sim/world.hpp"
#include "office_scene.hpp"
#include "simulated_scan.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

const std::string kWorldFile = test::datasets_dir() / "office.world";

TEST(OfficeWorld, IsWhatItsGeneratorMakes) {
  EXPECT_TRUE(read_text_file(kWorldFile) == office_world());
}

TEST(OfficeWorld, LooksLikeTheOfficeOfVoxels) {
  const World world = read_world(kWorldFile, {});
  EXPECT_TRUE(world.warnings.empty());
  EXPECT_TRUE(world.bounds_m.min().isApprox(Eigen::Vector3d(-0.1, -0.1, -0.1), 1e-6));
  EXPECT_TRUE(world.bounds_m.max().isApprox(Eigen::Vector3d(8.1, 6.1, 2.7), 1e-6));
  const Scene scene(world.mesh);
  const auto voxels = VoxelGrid::whole(make_office(0.05));
  Robot robot;
  robot.sensor.horizontal_pixels = 96;
  robot.sensor.vertical_pixels = 72;
  const SimulatedCamera camera(scene, robot.sensor, 0.0, 1);
  const Mast mast(robot.mast);
  for (const Transform& T_map_base : office_stops()) {
    const Transform T_map_sensor =
        T_map_base * mast.T_base_sensor({.pan_rad = 0.3, .tilt_rad = 0.1, .height_m = 0.413});
    const Scan of_scene = camera.capture(T_map_sensor, 0);
    const Scan of_voxels = simulate_scan(*voxels, robot.sensor, T_map_sensor);
    // Rays that graze an edge may pass in one and not in the other: furniture is not all on the
    // lattice. Nearly all meet the same surface.
    EXPECT_NEAR(static_cast<double>(of_scene.points_m.size()),
                static_cast<double>(of_voxels.points_m.size()), 0.02 * 96 * 72);
    const auto mean_distance_m = [](const Scan& scan) {
      double sum = 0.0;
      for (const Eigen::Vector3f& p : scan.points_m) sum += p.norm();
      return sum / static_cast<double>(scan.points_m.size());
    };
    EXPECT_NEAR(mean_distance_m(of_scene), mean_distance_m(of_voxels), 0.03);
  }
}

}  // namespace
}  // namespace nbvopt
