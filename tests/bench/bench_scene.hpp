// The maps that are measured on, with the views and the queries asked of them.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/planner.hpp"

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
};

/// ASLAM_lab.bt with the views and queries of its known answers, where they lie beside the
/// project; then the map that ships, with views and queries drawn in its free space by a seed.
std::vector<std::shared_ptr<const BenchScene>> make_bench_scenes();

}  // namespace nbvopt::bench
