#include "planner/pose_file.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::message_of;
using testing::HasSubstr;

PoseFile parse(const std::string& json, const Robot& robot = {}) {
  return parse_pose_file(json, "poses.json", robot);
}

std::string pose_file_refusal(const std::string& json) {
  return message_of<InputError>([&] { parse(json); });
}

/// A file of one good case, and then this one.
std::string refusal_of_case(const std::string& a_case) {
  return pose_file_refusal(
      R"({"cases": [{"position": [0, 0, 1], "orientation_xyzw": [0, 0, 0, 1]}, )" + a_case + "]}");
}

TEST(PoseFile, ReadsPositionAndQuaternion) {
  const PoseFile file = parse(
      R"({"cases": [{"position": [1, -2, 0.5], "orientation_xyzw": [0, 0, 2, 0], "gain": 7}]})");
  ASSERT_EQ(file.poses_T_map_sensor.size(), 1U);
  const Transform& T_map_sensor = file.poses_T_map_sensor[0];
  EXPECT_EQ(T_map_sensor.translation(), Eigen::Vector3d(1, -2, 0.5));
  EXPECT_TRUE(T_map_sensor.linear().isApprox(
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
  EXPECT_EQ(file.sensor, SensorOptions{});
}

TEST(PoseFile, ReadsBaseAndJointsBeyondTheirLimits) {
  Robot robot;
  robot.mast.sensor_offset_m << 0.1, 0.0, 0.0;
  const PoseFile file = parse(
      R"({"cases": [{"base": {"x": 1, "y": 2, "z": 0.5, "yaw": 0.3},
                     "pan": 9, "tilt": -1.2, "height": 1.5},
                    {"base": {"x": 1, "y": 2, "yaw": 0.3}, "pan": 0, "tilt": 0, "height": 0.4}]})",
      robot);
  ASSERT_EQ(file.poses_T_map_sensor.size(), 2U);
  const Mast mast(robot.mast);
  EXPECT_TRUE(file.poses_T_map_sensor[0].isApprox(
      base_pose(1, 2, 0.5, 0.3) * mast.T_base_sensor({9, -1.2, 1.5}), 1e-12));
  EXPECT_TRUE(file.poses_T_map_sensor[1].isApprox(
      base_pose(1, 2, 0, 0.3) * mast.T_base_sensor({0, 0, 0.4}), 1e-12));
}

TEST(PoseFile, PositionWinsOverBase) {
  const PoseFile file = parse(
      R"({"cases": [{"position": [1, 2, 3], "orientation_xyzw": [0, 0, 0, 1],
                     "base": {"x": 9, "y": 9, "yaw": 0}, "pan": 0, "tilt": 0, "height": 0.4}]})");
  EXPECT_EQ(file.poses_T_map_sensor.at(0).translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(PoseFile, SensorBlockOverridesTheRobot) {
  Robot robot;
  robot.sensor.range_max_m = 6.0;
  robot.sensor.focal_distance_m = 2.0;
  SensorOptions expected = robot.sensor;
  expected.range_max_m = 5.0;
  expected.horizontal_rays = 24;
  expected.counting = Counting::per_voxel;
  expected.near_blocking = false;
  EXPECT_EQ(parse(R"({"sensor": {"range_max_m": 5.0, "horizontal_rays": 24,
                                 "counting": "per_voxel", "near_blocking": false}, "cases": []})",
                  robot)
                .sensor,
            expected);
}

TEST(PoseFile, DepthAlongTheAxisImpliesTheReleasedCodesRays) {
  const SensorOptions sensor =
      parse(R"({"sensor": {"range_axis": "z_depth"}, "cases": []})").sensor;
  EXPECT_EQ(sensor.ray_pattern, RayPattern::equal_angles);
  EXPECT_FALSE(sensor.near_blocking);
}

TEST(PoseFile, MalformedFilesAreRefusedWithTheLine) {
  EXPECT_EQ(pose_file_refusal("{\n\"cases\": [\n{]\n}"), "poses.json: line 3: not valid JSON");
  EXPECT_EQ(pose_file_refusal(""), "poses.json: line 1: not valid JSON");
  EXPECT_EQ(pose_file_refusal("{\"cases\": []"), "poses.json: line 1: not valid JSON");
  EXPECT_EQ(pose_file_refusal("{\"cases\":\n[NaN]}"), "poses.json: line 2: not valid JSON");
  EXPECT_EQ(pose_file_refusal("\xff\xfe\n{}"), "poses.json: line 1: not valid JSON");
  EXPECT_EQ(pose_file_refusal("[]"), "poses.json must be an object {...}");
  EXPECT_EQ(pose_file_refusal("{}"), "poses.json: 'cases' is missing");
  EXPECT_EQ(pose_file_refusal(R"({"cases": {}})"), "poses.json: 'cases' must be a list [...]");
}

TEST(PoseFile, BadCasesAreRefusedWithTheirNumberAndField) {
  EXPECT_EQ(refusal_of_case("3"), "poses.json: cases[1] must be an object {...}");
  EXPECT_THAT(refusal_of_case("{}"), HasSubstr("poses.json: cases[1]: a pose is missing"));
  EXPECT_EQ(refusal_of_case(R"({"position": [0, 0, 0]})"),
            "poses.json: cases[1]: 'orientation_xyzw' is missing");
  EXPECT_EQ(refusal_of_case(R"({"orientation_xyzw": [0, 0, 0, 1]})"),
            "poses.json: cases[1]: 'position' is missing");
  EXPECT_EQ(refusal_of_case(R"({"position": [0, 0], "orientation_xyzw": [0, 0, 0, 1]})"),
            "poses.json: cases[1]: 'position' must be a list of 3 numbers");
  EXPECT_EQ(refusal_of_case(R"({"position": [0, 0, "1"], "orientation_xyzw": [0, 0, 0, 1]})"),
            "poses.json: cases[1]: 'position' must be a list of 3 numbers");
  EXPECT_EQ(refusal_of_case(R"({"position": [0, 0, null], "orientation_xyzw": [0, 0, 0, 1]})"),
            "poses.json: cases[1]: 'position' must be a list of 3 numbers");
  EXPECT_THAT(refusal_of_case(R"({"position": [0, 0, 0], "orientation_xyzw": [0, 0, 0, 0]})"),
              HasSubstr("poses.json: cases[1]: orientation_xyzw: the quaternion has length zero"));
  EXPECT_EQ(refusal_of_case(R"({"position": [0, 0, 1e999], "orientation_xyzw": [0, 0, 0, 1]})"),
            "poses.json: a number is too large");
  EXPECT_EQ(refusal_of_case(R"({"base": [0, 0, 0], "pan": 0, "tilt": 0, "height": 0})"),
            "poses.json: cases[1].base must be an object {...}");
  EXPECT_EQ(refusal_of_case(R"({"base": {"x": 0, "y": 0}, "pan": 0, "tilt": 0, "height": 0})"),
            "poses.json: cases[1].base: 'yaw' is missing");
  EXPECT_EQ(refusal_of_case(R"({"base": {"x": 0, "y": 0, "yaw": 0}, "pan": 0, "height": 0})"),
            "poses.json: cases[1]: 'tilt' is missing");
  EXPECT_EQ(refusal_of_case(
                R"({"base": {"x": 0, "y": 0, "yaw": true}, "pan": 0, "tilt": 0, "height": 0})"),
            "poses.json: cases[1].base: 'yaw' must be a number");
}

TEST(PoseFile, BadSensorBlocksAreRefusedByField) {
  const auto with_sensor = [](const std::string& block) {
    return pose_file_refusal(R"({"cases": [], "sensor": )" + block + "}");
  };
  EXPECT_EQ(with_sensor("4"), "poses.json: sensor must be an object {...}");
  EXPECT_EQ(with_sensor(R"({"range_max": 4})"),
            "poses.json: sensor: unknown key 'range_max', did you mean 'range_max_m'?");
  EXPECT_EQ(with_sensor(R"({"range_max_m": "4"})"),
            "poses.json: sensor.range_max_m is '4', it must be a number");
  EXPECT_EQ(with_sensor(R"({"range_max_m": null})"),
            "poses.json: sensor.range_max_m must be a number, a string, true or false");
  EXPECT_THAT(with_sensor(R"({"horizontal_rays": 0})"),
              HasSubstr("poses.json: sensor.horizontal_rays is 0"));
  EXPECT_THAT(with_sensor(R"({"range_min_m": 4, "range_max_m": 4})"),
              HasSubstr("poses.json: sensor.range_min_m is 4"));
}

}  // namespace
}  // namespace nbvopt
