#include "sim/exploration/volume/candidate_poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "nbvopt/mast/mast.hpp"
#include "sim/exploration/volume/drawn_map.hpp"

namespace nbvopt {
namespace {

constexpr double kQuarter_rad = std::numbers::pi / 2.0;

/// A frontier in the middle of a free layer of 49 x 49 voxels at the camera's height of 0.425 m,
/// its neighbourhood known to 1.2 m: of three rings of four poses around it, those of 0.5 and 1 m
/// are known.
class CandidatePoses : public testing::Test {
 protected:
  CandidatePoses() {
    for (int y = -24; y <= 24; ++y) {
      for (int x = -24; x <= 24; ++x) set(x, y, 8, VoxelState::free);
    }
    rules_.headings = 4;
    rules_.ring_min_m = 0.5;
    rules_.ring_max_m = 1.5;
  }

  void set(int x, int y, int z, VoxelState state) {
    test::set_state(map_, test::key_at(x, y, z), state);
  }

  std::vector<Eigen::Vector3d> poses(double pan_rad = 0.0) {
    map_.finish_writing();
    const Transform T_base_sensor =
        Mast(MastOptions{}).T_base_sensor({.pan_rad = pan_rad, .height_m = 0.425});
    return candidate_poses(*VoxelGrid::whole(map_), groups_,
                           base_pose(robot_map_m_.x(), robot_map_m_.y(), 0.0, 0.0), T_base_sensor,
                           rules_);
  }

  /// That many, each as expected.
  static void expect_poses(const std::vector<Eigen::Vector3d>& poses,
                           const std::vector<Eigen::Vector3d>& expected) {
    ASSERT_EQ(poses.size(), expected.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_TRUE(poses[i].head<2>().isApprox(expected[i].head<2>(), 1e-9)) << poses[i].transpose();
      EXPECT_NEAR(wrap_angle(poses[i].z() - expected[i].z()), 0.0, 1e-9);
    }
  }

  UncertaintyMap map_{0.05};
  std::vector<FrontierGroup> groups_{{{{0.025, 0.025}}}};
  Eigen::Vector2d robot_map_m_{1.0, 1.0};
  VolumeRules rules_ = rules_of(VolumeExplorer::bai2016);
};

TEST_F(CandidatePoses, RingAFrontierAndFaceIt) {
  const std::vector<Eigen::Vector3d> eight{{0.525, 0.025, 2 * kQuarter_rad},
                                           {0.025, 0.525, -kQuarter_rad},
                                           {-0.475, 0.025, 0.0},
                                           {0.025, -0.475, kQuarter_rad},
                                           {1.025, 0.025, 2 * kQuarter_rad},
                                           {0.025, 1.025, -kQuarter_rad},
                                           {-0.975, 0.025, 0.0},
                                           {0.025, -0.975, kQuarter_rad}};
  expect_poses(poses(), eight);
  std::vector<Eigen::Vector3d> turned = eight;
  for (Eigen::Vector3d& pose : turned) pose.z() -= 0.5;
  expect_poses(poses(/*pan_rad=*/0.5), turned);
}

TEST_F(CandidatePoses, KeepRoomAroundThem) {
  set(15, 0, 8, VoxelState::occupied);    // within 0.3 m of both poses to +x
  set(0, 10, 14, VoxelState::occupied);   // 0.3 m above one to +y
  set(-10, 0, 15, VoxelState::occupied);  // more than 0.3 m above one to -x
  set(-10, 0, 5, VoxelState::occupied);   // more than 0.1 m below it
  set(0, -10, 6, VoxelState::occupied);   // 0.1 m below one to -y
  expect_poses(poses(), {{-0.475, 0.025, 0.0},
                         {0.025, 1.025, -kQuarter_rad},
                         {-0.975, 0.025, 0.0},
                         {0.025, -0.975, kQuarter_rad}});
}

TEST_F(CandidatePoses, KeepAwayFromFrontiersAndTheRobot) {
  groups_.front().points_map_m.emplace_back(-0.9, 0.2);  // 0.19 m from the farther one to -x
  robot_map_m_ = {0.2, -0.475};                          // 0.175 m from the nearer one to -y
  rules_.ring_max_m = 1.0;
  expect_poses(poses(), {{0.525, 0.025, 2 * kQuarter_rad},
                         {0.025, 0.525, -kQuarter_rad},
                         {-0.475, 0.025, 0.0},
                         {1.025, 0.025, 2 * kQuarter_rad},
                         {0.025, 1.025, -kQuarter_rad},
                         {0.025, -0.975, kQuarter_rad}});
}

TEST_F(CandidatePoses, KeepAwayFromFrontiersOnAllSides) {
  rules_.ring_max_m = 0.5;
  for (int direction = 0; direction < 16; ++direction) {
    const double angle_rad = direction * kQuarter_rad / 4.0;
    const Eigen::Vector2d towards(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Vector2d pose_map_m(0.525, 0.025);
    groups_.front().points_map_m = {{0.025, 0.025}, pose_map_m + 0.29 * towards};
    EXPECT_EQ(poses().size(), 3U) << direction;
    groups_.front().points_map_m.back() = pose_map_m + 0.31 * towards;
    EXPECT_EQ(poses().size(), 4U) << direction;
  }
}

TEST_F(CandidatePoses, AreAsManyAsTheRulesSay) {
  groups_.front().points_map_m = {{0.025, 0.025}};
  rules_ = rules_of(VolumeExplorer::bai2016);
  rules_.ring_max_m = 1.0;
  EXPECT_EQ(poses().size(), 30U);
  rules_ = rules_of(VolumeExplorer::tekniker);
  rules_.ring_max_m = 1.0;
  robot_map_m_ = {3.0, 3.0};
  EXPECT_EQ(poses().size(), 24U);
}

}  // namespace
}  // namespace nbvopt
