#include <gmock/gmock.h>

#include "core/edit_distance.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/planner/robot_fields.hpp"
#include "support/error_message.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string robot_file_refusal(const std::string& yaml) {
  return message_of<InputError>([&] { parse_robot(yaml, "robot.yaml"); });
}

TEST(RobotFile, WhatIsLeftOutKeepsItsDefault) {
  Robot expected;
  expected.sensor.range_max_m = 3.5;
  expected.mast.pan_continuous = false;
  expected.mast.sensor_offset_m << 0.1, 0.0, -0.05;
  EXPECT_EQ(parse_robot("sensor:\n"
                        "  range_max_m: 3.5\n"
                        "mast: {pan_continuous: false, sensor_offset_m: [0.1, 0, -0.05]}\n",
                        "robot.yaml"),
            expected);
}

TEST(RobotFile, ReadsBackEveryFieldThatItWrites) {
  Robot robot;  // no field at its default
  robot.sensor = {.half_fov_horizontal_rad = 1.0 / 3.0,
                  .half_fov_vertical_rad = 0.25,
                  .horizontal_rays = 64,
                  .vertical_rays = 40,
                  .horizontal_pixels = 640,
                  .vertical_pixels = 400,
                  .range_min_m = 0.3,
                  .range_max_m = 5.5,
                  .focal_distance_m = 1.2,
                  .uncertainty_half_fov_horizontal_rad = 0.52,
                  .uncertainty_half_fov_vertical_rad = 0.41,
                  .uncertainty_mode = UncertaintyMode::angle,
                  .normal_weight = 0.25,
                  .ray_pattern = RayPattern::equal_angles,
                  .range_axis = RangeAxis::z_depth,
                  .counting = Counting::per_voxel,
                  .gain = GainKind::expected,
                  .visibility = Visibility::released,
                  .near_blocking = false,
                  .no_return = NoReturn::ignore,
                  .occupied_uncertainty = 0.7};
  robot.mast = {.pan_continuous = false,
                .pan_min_rad = -2.5,
                .pan_max_rad = 2.25,
                .pan_velocity_rad_s = 1.1,
                .tilt_min_rad = -0.6,
                .tilt_max_rad = 0.4,
                .tilt_velocity_rad_s = 0.9,
                .height_min_m = 0.2,
                .height_max_m = 0.9,
                .height_velocity_m_s = 0.05,
                .pan_axis_x_m = -0.1,
                .pan_axis_y_m = 0.05,
                .sensor_offset_m = {0.06, -0.01, 0.02}};
  EXPECT_EQ(parse_robot(to_yaml(robot), "robot.yaml"), robot);
}

TEST(RobotFile, ShippedPaperPlatformIsTheDefault) {
  EXPECT_EQ(read_robot(test::datasets_dir() / "robots/paper.yaml"), Robot{});
}

TEST(RobotFile, UnknownKeyIsRefusedWithTheNearest) {
  EXPECT_EQ(robot_file_refusal("sensor: {range_max: 4}"),
            "robot.yaml: sensor: unknown key 'range_max', did you mean 'range_max_m'?");
  EXPECT_EQ(robot_file_refusal("mast: {tilt_min_deg: -30}"),
            "robot.yaml: mast: unknown key 'tilt_min_deg', did you mean 'tilt_min_rad'?");
  EXPECT_EQ(robot_file_refusal("sensors: {}"),
            "robot.yaml: unknown block 'sensors', did you mean 'sensor'?");
}

TEST(RobotFile, WrongTypeIsRefused) {
  EXPECT_EQ(robot_file_refusal("sensor: {range_max_m: far}"),
            "robot.yaml: sensor.range_max_m is 'far', it must be a number");
  EXPECT_EQ(robot_file_refusal("sensor: {range_max_m: '4'}"),
            "robot.yaml: sensor.range_max_m is '4', it must be a number");
  EXPECT_EQ(robot_file_refusal("sensor: {horizontal_rays: 48.5}"),
            "robot.yaml: sensor.horizontal_rays is 48.5, it must be a whole number");
  EXPECT_EQ(robot_file_refusal("sensor: {horizontal_rays: 1e300}"),
            "robot.yaml: sensor.horizontal_rays is 1e+300, it must be a whole number");
  EXPECT_EQ(robot_file_refusal("sensor: {near_blocking: 1}"),
            "robot.yaml: sensor.near_blocking is 1, it must be true or false");
  EXPECT_EQ(robot_file_refusal("sensor: {counting: per_pixel}"),
            "robot.yaml: sensor.counting is 'per_pixel', it must be one of per_ray, per_voxel");
  EXPECT_EQ(robot_file_refusal("mast: {sensor_offset_m: [0, 1]}"),
            "robot.yaml: mast.sensor_offset_m is a list of 2 numbers, it must be a list of three "
            "numbers");
  EXPECT_EQ(robot_file_refusal("mast: {sensor_offset_m: [0, 1, up]}"),
            "robot.yaml: mast.sensor_offset_m must be a list of numbers");
  EXPECT_THAT(robot_file_refusal("sensor: {range_max_m: }"),
              HasSubstr("sensor.range_max_m has no value"));
  EXPECT_THAT(robot_file_refusal("sensor: {range_max_m: {m: 4}}"),
              HasSubstr("sensor.range_max_m has no"));
}

TEST(RobotFile, ValueThatFailsItsCheckIsRefused) {
  EXPECT_EQ(robot_file_refusal("sensor: {range_min_m: 5}"),
            "robot.yaml: sensor.range_min_m is 5, it must be less than range_max_m, which is 4");
  EXPECT_THAT(robot_file_refusal("sensor: {horizontal_rays: 0}"),
              HasSubstr("sensor.horizontal_rays is 0"));
  EXPECT_THAT(robot_file_refusal("sensor: {range_max_m: nan}"),
              HasSubstr("sensor.range_max_m is nan"));
  EXPECT_THAT(robot_file_refusal("mast: {tilt_velocity_rad_s: -1}"),
              HasSubstr("mast.tilt_velocity_rad_s is -1"));
}

TEST(RobotFile, WhatIsGivenTwiceIsRefused) {
  EXPECT_EQ(robot_file_refusal("sensor:\n  range_max_m: 4\n  range_max_m: 5\n"),
            "robot.yaml: sensor.range_max_m is given twice, keep one");
  EXPECT_EQ(robot_file_refusal("sensor: {}\nsensor: {}\n"),
            "robot.yaml: block 'sensor' is given twice, keep one");
}

TEST(RobotFile, WhatIsNoRobotIsRefusedInOneLine) {
  for (const char* yaml : {"", "just words", "[1, 2]", "sensor: 4", "sensor: [1]",
                           "sensor: {range_max_m: 4", "? {a: b}\n: c", "a: &a [*a]", "\t:\n:-"}) {
    EXPECT_THAT(robot_file_refusal(yaml), AllOf(HasSubstr("robot.yaml: "), Not(HasSubstr("\n"))))
        << yaml;
  }
  EXPECT_THAT(robot_file_refusal("sensor:\n  range_max_m: [1\n"), HasSubstr("robot.yaml: line "));
}

TEST(RobotFile, MissingFileIsNamed) {
  EXPECT_THAT(message_of<InputError>([] { read_robot("no/such/robot.yaml"); }),
              HasSubstr("no/such/robot.yaml: "));
}

TEST(RobotFields, DepthAlongTheAxisImpliesTheReleasedCodesRays) {
  const std::vector<FieldSetting> axis_only{{"range_axis", "z_depth"}};
  SensorOptions sensor;
  set_fields(sensor, axis_only, "poses.json");
  EXPECT_EQ(sensor.ray_pattern, RayPattern::equal_angles);
  EXPECT_FALSE(sensor.near_blocking);

  const std::vector<FieldSetting> all_given{
      {"range_axis", "z_depth"}, {"ray_pattern", "pixel_centres"}, {"near_blocking", true}};
  set_fields(sensor, all_given, "poses.json");
  EXPECT_EQ(sensor.ray_pattern, RayPattern::pixel_centres);
  EXPECT_TRUE(sensor.near_blocking);
}

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("same", "same"), 0U);
}

}  // namespace
}  // namespace nbvopt
