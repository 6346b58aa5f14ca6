// Looking, mapping and planning in turn: what each search has learned of the office in the end.
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "nbvopt/planner/view_planner.hpp"
#include "nbvopt/solver/registry.hpp"
#include "office_scene.hpp"
#include "simulated_scan.hpp"
#include "support/paths.hpp"
#include "support/sanitizers.hpp"

namespace nbvopt {
namespace {

constexpr int kRounds = 12;
constexpr std::size_t kStopsApart = test::kAddressSanitizer ? 4 : 1;

/// The paper's platform, its depth image thinned out.
Robot coarse_robot(GainKind gain) {
  Robot robot;
  robot.sensor.gain = gain;
  robot.sensor.horizontal_pixels = 160;
  robot.sensor.vertical_pixels = 120;
  return robot;
}

/// A robot at one place of the office, which knows a part of it.
class Explorer {
 public:
  Explorer(const VoxelGrid& office, UncertaintyMap known, GainKind gain,
           const Transform& T_map_base)
      : office_(office),
        map_(std::make_shared<SharedMap>(std::move(known))),
        planner_(map_, coarse_robot(gain)) {
    request_.T_map_base = T_map_base;
    request_.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
    request_.motion_time_s = 0.5;
    look();
  }

  /// The information in the map after some rounds of planning and looking; without a solver the
  /// camera stays.
  double explore(const Solver* solver) {
    for (int round = 0; round < kRounds; ++round) {
      if (solver != nullptr) request_.joints = planner_.plan(request_, *solver).joints;
      look();
    }
    return map_->map().counts().information;
  }

 private:
  void look() {
    const Transform pose = T_map_sensor(request_, planner_.mast(), request_.joints);
    planner_.insert(simulate_scan(office_, planner_.robot().sensor, pose), pose);
  }

  const VoxelGrid& office_;
  std::shared_ptr<SharedMap> map_;
  ViewPlanner planner_;
  PlanRequest request_;
};

/// What each search has learned in the end.
struct Information {
  double still = 0.0;
  double pan_grid = 0.0;
  double all_joints = 0.0;
};

using MakeMap = std::function<UncertaintyMap()>;

Information explore(const VoxelGrid& office, const MakeMap& known, GainKind gain,
                    const Transform& T_map_base) {
  const auto learned_by = [&](const Solver* solver) {
    return Explorer(office, known(), gain, T_map_base).explore(solver);
  };
  const Information learned{learned_by(nullptr),
                            learned_by(make_solver("grid", {.grid_steps = {0.1, 0.0, 0.0}}).get()),
                            learned_by(make_solver("auto", {}).get())};
  std::cout << "information: still camera " << learned.still << ", pan grid " << learned.pan_grid
            << ", auto " << learned.all_joints << '\n';
  return learned;
}

TEST(ClosedLoop, LearnsMostOfTheRestBySearchingAllJoints) {
  const auto office = VoxelGrid::whole(make_office(0.05));
  const MakeMap shipped = [] { return read_map(test::datasets_dir() / "office_partial.ot"); };
  for (const std::size_t stop : {7, 10}) {
    const Information learned = explore(*office, shipped, GainKind::positive, office_stops()[stop]);
    EXPECT_GT(learned.pan_grid, learned.still);
    EXPECT_GT(learned.all_joints, 1.1 * learned.pan_grid);
  }
}

/// Summed over the stops: where a low camera looks down at a floor that it never saw from farther
/// than range_min, it expects to see below it for ever, and pan alone may have learned more.
TEST(ClosedLoop, LearnsMostFromNothingBySearchingAllJoints) {
  constexpr double kResolution_m = 0.1;
  const auto office = VoxelGrid::whole(make_office(kResolution_m));
  Information sum;
  for (const Transform& T_map_base : office_stops()) {
    const Information learned = explore(
        *office, [] { return UncertaintyMap(kResolution_m); }, GainKind::expected, T_map_base);
    sum.still += learned.still;
    sum.pan_grid += learned.pan_grid;
    sum.all_joints += learned.all_joints;
  }
  EXPECT_GT(sum.pan_grid, sum.still);
  EXPECT_GT(sum.all_joints, 1.1 * sum.pan_grid);
}

}  // namespace
}  // namespace nbvopt
