// Planners on small worlds, and what all their answers keep.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "nbvopt/solver/registry.hpp"
#include "planner/planner.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {

/// A gain that is a function of the camera's pose, and no map.
class MadeUpGain final : public ViewEvaluator {
 public:
  using OfPose = std::function<double(const Transform& T_map_sensor)>;
  using OfView = std::function<double(double yaw_rad, double pitch_rad, double z_m)>;

  explicit MadeUpGain(OfPose gain) : gain_(std::move(gain)) {}
  std::string name() const override { return "made-up"; }
  ViewGain evaluate(const Transform& T_map_sensor) const override {
    ViewGain view;
    view.gain = gain_(T_map_sensor);
    return view;
  }

 private:
  OfPose gain_;
};

/// The planner of a small camera on a map, with the exact evaluator unless another is given.
struct World {
  Robot robot;
  std::shared_ptr<const VoxelGrid> grid;
  std::shared_ptr<const ViewEvaluator> evaluator;

  explicit World(const UncertaintyMap& map, double range_max_m = 1.0)
      : grid(VoxelGrid::whole(map)) {
    robot.sensor.horizontal_rays = 12;
    robot.sensor.vertical_rays = 9;
    robot.sensor.range_max_m = range_max_m;
    evaluator = make_exact_evaluator(grid, DepthCamera(robot.sensor));
  }
  World(const UncertaintyMap& map, MadeUpGain::OfPose gain) : World(map) {
    evaluator = std::make_shared<MadeUpGain>(std::move(gain));
  }
  World(const UncertaintyMap& map, const MadeUpGain::OfView& gain)
      : World(map, MadeUpGain::OfPose([gain](const Transform& T_map_sensor) {
                const Eigen::Vector3d ahead = T_map_sensor.linear().col(2);
                return gain(std::atan2(ahead.y(), ahead.x()), std::asin(ahead.z()),
                            T_map_sensor.translation().z());
              })) {}

  Planner planner() const { return {robot, grid, evaluator}; }

  ViewGain view(const PlanRequest& request, const JointPosition& joints) const {
    return evaluator->evaluate(T_map_sensor(request, Mast(robot.mast), joints));
  }
};

inline std::unique_ptr<Solver> pan_grid(double step_rad) {
  return make_solver("grid", {.grid_steps = {step_rad, 0.0, 0.0}});
}

inline PlanRequest request_at(const JointPosition& joints, double motion_time_s) {
  PlanRequest request;
  request.T_map_base = base_pose(0.03, 0.02, 0.01, 0.0);
  request.joints = joints;
  request.motion_time_s = motion_time_s;
  return request;
}

inline constexpr JointPosition kMiddle{0.0, 0.0, 0.4};

/// Free space within two metres, and what `furnish` adds.
inline UncertaintyMap free_cube(const std::function<void(UncertaintyMap&)>& furnish = nullptr) {
  UncertaintyMap map(0.1);
  set_box(map, cube(key_from_origin(-20, -20, -20), 40), kFree);
  if (furnish) furnish(map);
  map.finish_writing();
  return map;
}

/// What every answer keeps.
inline void expect_contract(const World& world, const PlanRequest& request,
                            const PlanResult& result) {
  const Mast mast(world.robot.mast);
  EXPECT_NE(result.status, PlanStatus::not_run);
  EXPECT_FALSE(result.message.empty());
  EXPECT_TRUE(result.box.contains(result.joints.vector())) << result.joints.vector().transpose();
  EXPECT_TRUE(result.box.contains(request.joints.vector()));
  const JointBox reachable = mast.reachable_box(request.joints, request.motion_time_s);
  EXPECT_TRUE(reachable.contains(result.box.min));
  EXPECT_TRUE(reachable.contains(result.box.max));
  EXPECT_EQ(result.view, world.view(request, result.joints)) << "the gain is exact";
  EXPECT_EQ(result.current, world.view(request, request.joints));
  EXPECT_GE(result.view.gain, result.current.gain);
  EXPECT_EQ(result.T_map_sensor.matrix(), T_map_sensor(request, mast, result.joints).matrix());
  EXPECT_EQ(result.move_time_s, mast.move_time_s(request.joints, result.joints));
  if (request.motion_time_s > 0.0) {
    EXPECT_LE(result.move_time_s, request.motion_time_s * (1.0 + 1e-12));
  }
  EXPECT_GE(result.evaluations, 1);
  EXPECT_GE(result.search_time_ms, 0.0);
  EXPECT_EQ(result.seed, request.seed);
  EXPECT_EQ(result.map_version, world.grid->version());
  if (result.status == PlanStatus::no_gain_in_reach) {
    EXPECT_EQ(result.joints, request.joints);
    if (result.message.find("inside an obstacle") == std::string::npos) {
      EXPECT_LT(result.view.gain, request.min_gain.value_or(1.0));
    }
  }
}

/// The end of every ray, from 100 random joint positions in reach, lies in the reach's sight.
inline void expect_views_within_reach(const World& world, const PlanRequest& request,
                                      std::mt19937_64& random) {
  const Mast mast(world.robot.mast);
  const CameraRays rays = DepthCamera(world.robot.sensor).rays();
  const Reach reach = reach_of(request, mast, world.robot.sensor, world.grid->lattice());
  const JointBox& box = reach.joints;
  for (int i = 0; i < 100; ++i) {
    const JointPosition q{uniform(random, box.min[0], box.max[0]),
                          uniform(random, box.min[1], box.max[1]),
                          uniform(random, box.min[2], box.max[2])};
    const Transform T = T_map_sensor(request, mast, q);
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
      const Eigen::Vector3d end = T * (rays.direction(ray) * rays.range_max_m[ray]);
      ASSERT_LE(reach.sight.distance_m(end), reach.sight.radius_m);
    }
  }
}

}  // namespace nbvopt::test
