// The contract of every solver of the registry, on what it is for: the gain and its surrogate on
// the shipped map.
#include <gtest/gtest.h>

#include <optional>

#include "nbvopt/map/map_file.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/solver/registry.hpp"
#include "planner/panorama_objective.hpp"
#include "planner/view_objective.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

constexpr std::int64_t kLimit = 40;

/// A query in the middle of the office.
struct OfficeQuery {
  UncertaintyMap map = read_map(datasets_dir() / "office_partial.ot");
  std::shared_ptr<const VoxelGrid> grid = VoxelGrid::lazy(map);
  Robot robot;
  JointPosition joints{.pan_rad = 0.3, .tilt_rad = -0.1, .height_m = 0.4};
  MovingMast mast{Mast(robot.mast), base_pose(1.9, 2.6, 0.0, 1.57), {}, joints};
  JointBox box = mast.mast().reachable_box(joints, 1.0);
  std::unique_ptr<const ViewEvaluator> exact =
      make_exact_evaluator(grid, DepthCamera(robot.sensor));
  PanoramaObjective surrogate{
      grid,          robot.sensor, mast, box, planning_panorama(robot.sensor.counting),
      HazardTable(), nullptr};
  ViewObjective gain{mast, robot.sensor, box, *exact, &surrogate, nullptr};

  /// What the solver can work on: the exact gain, or the surrogate where it needs more.
  const Objective& objective_for(const Solver& solver) const {
    const SolverNeeds needs = solver.needs();
    return needs.gradient || needs.residuals ? static_cast<const Objective&>(surrogate) : gain;
  }
};

class SolverOnMap : public ::testing::TestWithParam<std::string> {};

TEST_P(SolverOnMap, KeepsTheContract) {
  const auto solver = make_solver(GetParam(), {.grid_steps = {0.8, 0.5, 0.1}});
  std::optional<SolveResult> first;
  for (int run = 0; run < 2; ++run) {
    const OfficeQuery query;
    const Objective& objective = query.objective_for(*solver);
    SolveRequest request{query.joints.vector(), {}, 7};
    request.stop.max_evaluations = kLimit;
    const SolveResult result = solver->solve(objective, request);

    EXPECT_TRUE(objective.box().contains(result.best));
    EXPECT_GT(result.value, objective.value(request.start)) << "there is more to see elsewhere";
    // Sums over all hits and over patches round differently.
    const double value = objective.value(result.best);
    EXPECT_NEAR(result.value, value, solver->needs().residuals ? 1e-6 * value : 0.0);
    EXPECT_LE(result.evaluations + result.surrogate_evaluations, kLimit);
    EXPECT_NE(result.status, SolveStatus::not_run);
    if (first) {
      EXPECT_EQ(result.best, first->best);
      EXPECT_EQ(result.value, first->value);
      EXPECT_EQ(result.evaluations, first->evaluations);
    }
    first = result;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SolverOnMap, ::testing::ValuesIn(solver_names()),
                         [](const auto& name_of) {
                           std::string name = name_of.param;
                           for (char& c : name) {
                             if (c == ':' || c == '-') c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace nbvopt::test
