// Maps with known answers: those of datasets/, and those that lie beside the project, where they
// are there.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {

/// Skips the test, saying so, where the shared maps and oracles are not there.
#define NBVOPT_REQUIRE_SHARED()                                          \
  if (!std::filesystem::exists(::nbvopt::test::shared_dir() / "oracle")) \
  GTEST_SKIP() << "the maps and known answers of ../shared are not here, so this was not tested"

/// The file with known answers of this name: what ships, or else what is shared.
inline std::filesystem::path oracle_file(const std::string& name) {
  const std::filesystem::path shipped = datasets_dir() / "oracle" / name;
  return std::filesystem::exists(shipped) ? shipped : shared_dir() / "oracle" / name;
}

/// The map of this name, likewise.
inline std::filesystem::path known_map_file(const std::string& name) {
  const std::filesystem::path shipped = datasets_dir() / name;
  return std::filesystem::exists(shipped) ? shipped : shared_dir() / "maps" / name;
}

/// Skips the test, saying so, where these known answers are not there; those that ship always are.
#define NBVOPT_REQUIRE_ORACLE(name)                                   \
  if (!std::filesystem::exists(::nbvopt::test::oracle_file(name)))    \
  GTEST_SKIP() << (name) << ": these known answers of ../shared are " \
               << "not here, so this was not tested"

inline nlohmann::json read_oracle(const std::string& name) {
  std::ifstream in(oracle_file(name));
  return nlohmann::json::parse(in);
}

/// The map that an oracle file tells of.
inline std::filesystem::path oracle_map_file(const nlohmann::json& oracle) {
  return known_map_file(oracle.at("map").get<std::string>());
}

/// The sensor block of an oracle file.
inline SensorOptions oracle_sensor(const nlohmann::json& oracle) {
  const nlohmann::json& s = oracle.at("sensor");
  SensorOptions sensor;
  sensor.half_fov_horizontal_rad = s.at("half_fov_horizontal_rad");
  sensor.half_fov_vertical_rad = s.at("half_fov_vertical_rad");
  sensor.horizontal_rays = s.at("horizontal_rays");
  sensor.vertical_rays = s.at("vertical_rays");
  sensor.range_min_m = s.at("range_min_m");
  sensor.range_max_m = s.at("range_max_m");
  sensor.focal_distance_m = s.at("focal_distance_m");
  if (s.at("range_axis") == "z_depth") {
    sensor.range_axis = RangeAxis::z_depth;
    sensor.ray_pattern = RayPattern::equal_angles;
    sensor.uncertainty_half_fov_horizontal_rad = s.at("uncertainty_half_fov_horizontal_rad");
    sensor.uncertainty_half_fov_vertical_rad = s.at("uncertainty_half_fov_vertical_rad");
    sensor.near_blocking = false;
  }
  return sensor;
}

inline Transform oracle_base(const nlohmann::json& c) {
  const nlohmann::json& base = c.at("base");
  return base_pose(base.at("x"), base.at("y"), 0.0, base.at("yaw"));
}

inline JointPosition oracle_joints(const nlohmann::json& j) {
  return {j.at("pan"), j.at("tilt"), j.at("height")};
}

inline std::vector<Transform> oracle_poses(const nlohmann::json& oracle) {
  std::vector<Transform> poses;
  for (const nlohmann::json& c : oracle.at("cases")) {
    poses.push_back(pose_from_quaternion(c.at("position").get<std::array<double, 3>>(),
                                         c.at("orientation_xyzw").get<std::array<double, 4>>()));
  }
  return poses;
}

}  // namespace nbvopt::test
