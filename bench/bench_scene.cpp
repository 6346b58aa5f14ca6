#include "bench/bench_scene.hpp"

#include <iostream>
#include <numbers>
#include <random>

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"

namespace nbvopt::bench {
namespace {

/// A map of ../shared with the views and the queries of its known answers.
BenchScene make_known_scene(const std::string& name) {
  const nlohmann::json views = test::read_oracle(name + ".json");
  const nlohmann::json queries = test::read_oracle(name + "_optima.json");
  const std::filesystem::path file = test::oracle_map_file(queries);
  BenchScene scene{.name = name,
                   .map_file = file,
                   .map = read_map(file),
                   .paper_code_sensor = test::oracle_sensor(views),
                   .poses_T_map_sensor = test::oracle_poses(views),
                   .robot = {.sensor = test::oracle_sensor(queries), .mast = {}},
                   .requests = {},
                   .best_gains = {}};
  for (const nlohmann::json& known : queries.at("cases")) {
    PlanRequest request;
    request.T_map_base = test::oracle_base(known);
    request.joints = test::oracle_joints(known);
    request.motion_time_s = known.at("time_budget_s");
    scene.requests.push_back(request);
    scene.best_gains.push_back(known.at("best_gain"));
  }
  return scene;
}

/// A robot that stands somewhere in the map, its camera in free space.
PlanRequest draw_request(const UncertaintyMap& map, const Mast& mast, std::mt19937_64& random) {
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const KeyBox known = map.known_box().value();
  const Eigen::Vector3d low_m = map.lattice().centre_m(known.min);
  const Eigen::Vector3d high_m = map.lattice().centre_m(known.max);
  const MastOptions& limits = mast.options();
  PlanRequest request;
  request.motion_time_s = 1.0;
  VoxelState state = VoxelState::unknown;
  while (state != VoxelState::free) {
    request.T_map_base = base_pose(uniform(low_m.x(), high_m.x()), uniform(low_m.y(), high_m.y()),
                                   0.0, uniform(-std::numbers::pi, std::numbers::pi));
    request.joints = {.pan_rad = uniform(-std::numbers::pi, std::numbers::pi),
                      .tilt_rad = uniform(limits.tilt_min_rad, limits.tilt_max_rad),
                      .height_m = uniform(limits.height_min_m, limits.height_max_m)};
    const Transform T_map_camera = T_map_sensor(request, mast, request.joints);
    state = map.at(map.lattice().key(T_map_camera.translation())).state;
  }
  return request;
}

BenchScene make_office_partial() {
  constexpr std::size_t kViews = 48;
  constexpr std::size_t kQueries = 12;
  const std::filesystem::path file = test::datasets_dir() / "office_partial.ot";
  BenchScene scene{.name = "office_partial",
                   .map_file = file,
                   .map = read_map(file),
                   .paper_code_sensor = paper_code_sensor(SensorOptions{}),
                   .poses_T_map_sensor = {},
                   .robot = {},
                   .requests = {},
                   .best_gains = {}};
  const Mast mast(scene.robot.mast);
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < kViews; ++i) {
    const PlanRequest request = draw_request(scene.map, mast, random);
    scene.poses_T_map_sensor.push_back(T_map_sensor(request, mast, request.joints));
    if (i < kQueries) scene.requests.push_back(request);
  }
  return scene;
}

}  // namespace

std::vector<std::shared_ptr<const BenchScene>> make_bench_scenes(
    const std::vector<std::string>& known_names) {
  std::vector<std::shared_ptr<const BenchScene>> scenes;
  if (std::filesystem::exists(test::shared_dir() / "oracle")) {
    for (const std::string& name : known_names) {
      scenes.push_back(std::make_shared<BenchScene>(make_known_scene(name)));
    }
  } else {
    std::cerr << "The maps and known answers of ../shared are not here: only the map that ships is "
                 "measured.\n";
  }
  scenes.push_back(std::make_shared<BenchScene>(make_office_partial()));
  return scenes;
}

}  // namespace nbvopt::bench
