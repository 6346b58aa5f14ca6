#include "nbvopt/core/transform.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using std::numbers::pi;

TEST(BasePose, RefusesAYawThatIsNoAngle) {
  EXPECT_THROW(base_pose(0, 0, 0, 1e300), InputError);
  EXPECT_THROW(base_pose(0, 0, 0, -2e4), InputError);
  EXPECT_NO_THROW(base_pose(0, 0, 0, 9999.0));
}

TEST(BasePose, TurnsCounterClockwiseThenMoves) {
  const Transform T_map_base = base_pose(1.0, 2.0, 0.3, pi / 2);
  const Eigen::Vector3d p_map = T_map_base * Eigen::Vector3d(1.0, 0.0, 0.0);
  EXPECT_TRUE(p_map.isApprox(Eigen::Vector3d(1.0, 3.0, 0.3), 1e-15)) << p_map.transpose();
}

TEST(RotationBodySensor, TakesOpticalAxesToBodyAxes) {
  const Eigen::Matrix3d O = rotation_body_sensor();
  EXPECT_EQ(O * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());   // forward
  EXPECT_EQ(O * Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY());  // right
  EXPECT_EQ(O * Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ());  // down
  EXPECT_DOUBLE_EQ(O.determinant(), 1.0);
}

TEST(PoseFromQuaternion, NormalisesAnyLength) {
  const double s = std::sqrt(0.5);
  const Transform T = pose_from_quaternion({1.0, 2.0, 3.0}, {0.0, 0.0, 7.0 * s, 7.0 * s});
  EXPECT_TRUE(T.linear().isApprox(base_pose(0, 0, 0, pi / 2).linear(), 1e-14));
  EXPECT_EQ(T.translation(), Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST(PoseFromQuaternion, RefusesWhatIsNoPose) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(pose_from_quaternion({nan, 0, 0}, {0, 0, 0, 1}), InputError);
  EXPECT_THROW(pose_from_quaternion({0, inf, 0}, {0, 0, 0, 1}), InputError);
  EXPECT_THROW(pose_from_quaternion({0, 0, 0}, {0, 0, 0, nan}), InputError);
  EXPECT_THROW(pose_from_quaternion({0, 0, 0}, {0, 0, 0, 0}), InputError);
}

TEST(WrapAngle, AnswersInTheHalfOpenTurn) {
  EXPECT_DOUBLE_EQ(wrap_angle(0.5), 0.5);
  EXPECT_DOUBLE_EQ(wrap_angle(0.5 + 4 * pi), 0.5);
  EXPECT_DOUBLE_EQ(wrap_angle(-0.5 - 2 * pi), -0.5);
  EXPECT_DOUBLE_EQ(wrap_angle(pi), pi);
  EXPECT_DOUBLE_EQ(wrap_angle(-pi), pi);
  EXPECT_DOUBLE_EQ(wrap_angle(1.5 * pi), -0.5 * pi);
}

}  // namespace
}  // namespace nbvopt
