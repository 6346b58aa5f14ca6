// The maps that are measured on, with the views and the queries asked of them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt::bench {

struct BenchScene {
  std::string name;
  std::filesystem::path map_file;
  UncertaintyMap map;
  /// Of paper-code, and of exact where both are compared: the same rays and range axis.
  SensorOptions paper_code_sensor;
  std::vector<Transform> poses_T_map_sensor;
  Robot robot;  ///< of the queries
  std::vector<PlanRequest> requests;
  std::vector<double> best_gains;  ///< of the requests, where another program found them; or empty
};

/// The maps of these names with the views and queries of their known answers, where they lie beside
/// the project (a line on standard error says so if not); then the map that ships, with views and
/// queries drawn in its free space by a seed.
std::vector<std::shared_ptr<const BenchScene>> make_bench_scenes(
    const std::vector<std::string>& known_names);

}  // namespace nbvopt::bench
