// The planner against answers that an independent program found by brute force.
#include <gtest/gtest.h>

#include <algorithm>

#include "nbvopt/map/map_file.hpp"
#include "nbvopt/planner/planner.hpp"
#include "nbvopt/solver/registry.hpp"
#include "support/oracle.hpp"

namespace nbvopt {
namespace {

/// One grazing ray, or rounding.
double tolerance(double gain) { return std::max(5e-4 * gain, 1.0); }

class Optima : public ::testing::TestWithParam<const char*> {};

TEST_P(Optima, AreReproduced) {
  NBVOPT_REQUIRE_SHARED();
  const nlohmann::json oracle = test::read_oracle(std::string(GetParam()) + "_optima.json");
  Robot robot;
  robot.sensor = test::oracle_sensor(oracle);
  const UncertaintyMap map =
      read_map(test::shared_dir() / "maps" / oracle.at("map").get<std::string>());
  const auto grid = VoxelGrid::lazy(map);
  const std::shared_ptr<const ViewEvaluator> exact =
      make_exact_evaluator(grid, DepthCamera(robot.sensor));
  const Planner planner(robot, grid, exact);
  const auto pan_grid =
      make_solver("grid", {.grid_steps = {oracle.at("pan_grid_step_rad"), 0.0, 0.0}});
  const Mast mast(robot.mast);
  for (const nlohmann::json& known : oracle.at("cases")) {
    PlanRequest request;
    request.T_map_base = test::oracle_base(known);
    request.joints = test::oracle_joints(known);
    request.motion_time_s = known.at("time_budget_s");
    const PlanResult result = planner.plan(request, *pan_grid);
    const double current = known.at("current_gain");
    const double best_of_grid = known.at("pan_grid_gain");
    const double best = known.at("best_gain");
    EXPECT_NEAR(result.current.gain, current, tolerance(current)) << known;
    EXPECT_NEAR(result.view.gain, best_of_grid, tolerance(best_of_grid)) << known;
    const JointPosition best_joints = test::oracle_joints(known.at("best"));
    EXPECT_NEAR(exact->evaluate(T_map_sensor(request, mast, best_joints)).gain, best,
                tolerance(best))
        << known;
    EXPECT_TRUE(result.box.contains(best_joints.vector()) ||
                (best_joints.vector() -
                 best_joints.vector().cwiseMax(result.box.min).cwiseMin(result.box.max))
                        .norm() < 1e-9)
        << known;
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, Optima, ::testing::Values("ASLAM_lab", "apartment_partial"));

}  // namespace
}  // namespace nbvopt
