// Looking, mapping and planning in turn: what each search has learned of the office in the end.
#include <gtest/gtest.h>

#include <iostream>

#include "nbvopt/map/scan.hpp"
#include "nbvopt/planner/planner.hpp"
#include "nbvopt/solver/registry.hpp"
#include "office_scene.hpp"
#include "simulated_scan.hpp"

namespace nbvopt {
namespace {

constexpr double kResolution_m = 0.1;

constexpr int kRounds = 12;

/// The paper's platform, its depth image thinned out.
Robot coarse_robot() {
  Robot robot;
  robot.sensor.horizontal_pixels = 160;
  robot.sensor.vertical_pixels = 120;
  return robot;
}

/// A robot at one place of the office, which knows what it has seen.
class Explorer {
 public:
  explicit Explorer(const Transform& T_map_base) {
    request_.T_map_base = T_map_base;
    request_.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
    request_.motion_time_s = 0.5;
    look();
  }

  /// The information in the map after some rounds of planning and looking; without a solver the
  /// camera stays.
  double explore(const Solver* solver) {
    for (int round = 0; round < kRounds; ++round) {
      if (solver != nullptr) move(*solver);
      look();
    }
    return map_.counts().information;
  }

 private:
  void move(const Solver& solver) {
    const auto grid = VoxelGrid::whole(map_);
    const Planner planner(robot_, grid, make_exact_evaluator(grid, DepthCamera(robot_.sensor)));
    request_.joints = planner.plan(request_, solver).joints;
  }

  void look() {
    static const auto world = VoxelGrid::whole(make_office(kResolution_m));
    const Transform pose = T_map_sensor(request_, Mast(robot_.mast), request_.joints);
    insert_scan(map_, simulate_scan(*world, robot_.sensor, pose), pose, robot_.sensor);
  }

  Robot robot_ = coarse_robot();
  UncertaintyMap map_{kResolution_m};
  PlanRequest request_;
};

class ClosedLoop : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ClosedLoop, LearnsMostBySearchingAllJoints) {
  const Transform T_map_base = office_stops().at(GetParam());
  const auto pan_grid = make_solver("grid", {.grid_steps = {0.1, 0.0, 0.0}});
  const auto search = make_solver("auto", {});
  const double still = Explorer(T_map_base).explore(nullptr);
  const double pan_only = Explorer(T_map_base).explore(pan_grid.get());
  const double all_joints = Explorer(T_map_base).explore(search.get());
  std::cout << "information: still camera " << still << ", pan grid " << pan_only << ", auto "
            << all_joints << '\n';
  EXPECT_GT(pan_only, still);
  EXPECT_GT(all_joints, 1.1 * pan_only);
}

INSTANTIATE_TEST_SUITE_P(Stops, ClosedLoop, ::testing::Values(0, 5));

}  // namespace
}  // namespace nbvopt
