#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include <utility>

#include "bench/measurements.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "office_scene.hpp"
#include "simulated_scan.hpp"

namespace nbvopt::bench {
namespace {

constexpr const char* kInsertionScene = "office, growing";

/// A camera's scans, with the places where they were taken.
struct Recording {
  std::vector<Transform> poses_T_map_sensor;
  std::vector<Scan> scans;
};

Recording record_office() {
  constexpr double kResolution_m = 0.05;
  const auto world = VoxelGrid::whole(make_office(kResolution_m));
  const Mast mast{MastOptions{}};
  Recording recording;
  for (const Transform& T_map_base : office_stops()) {
    recording.poses_T_map_sensor.push_back(T_map_base * mast.T_base_sensor({.height_m = 0.4}));
    recording.scans.push_back(
        simulate_scan(*world, SensorOptions{}, recording.poses_T_map_sensor.back()));
  }
  return recording;
}

octomap::point3d octomap_point(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// As OctoMap takes a scan: its range is an argument, and it knows no ray without a return but one
/// that ends beyond.
octomap::Pointcloud octomap_cloud(const Scan& scan, const Transform& T_map_sensor) {
  const double beyond_m = 2.0 * SensorOptions{}.range_max_m;
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& p_sensor_m : scan.points_m) {
    cloud.push_back(octomap_point(T_map_sensor * p_sensor_m.cast<double>()));
  }
  for (const Eigen::Vector3f& direction : scan.no_returns) {
    cloud.push_back(
        octomap_point(T_map_sensor * (direction.cast<double>().normalized() * beyond_m)));
  }
  return cloud;
}

/// OctoMap's own insertion of the same scans, which knows no uncertainty; its discretised one walks
/// one ray a voxel that holds ends of rays, and misses what only the others pass.
Measurement octomap_insertion(const std::shared_ptr<const Recording>& recording,
                              double resolution_m, bool is_discretised, std::string name) {
  const auto tree = std::make_shared<octomap::OcTree>(resolution_m);
  const auto insert = [recording, tree, is_discretised](std::size_t i) {
    if (i == 0) tree->clear();
    const Transform& T_map_sensor = recording->poses_T_map_sensor[i];
    const octomap::Pointcloud cloud = octomap_cloud(recording->scans[i], T_map_sensor);
    return seconds_of([&] {
      tree->insertPointCloud(cloud, octomap_point(T_map_sensor.translation()),
                             SensorOptions{}.range_max_m, false, is_discretised);
    });
  };
  return {.scene = kInsertionScene,
          .name = std::move(name),
          .run = insert,
          .items = recording->scans.size()};
}

}  // namespace

void add_map_measurements(const std::shared_ptr<const BenchScene>& scene,
                          std::vector<Measurement>& measurements) {
  const auto fill_bricks = [scene](std::size_t i) {
    const PlanRequest& request = scene->requests[i];
    return seconds_of(
        [&] { ViewPlanner(VoxelGrid::lazy(scene->map), scene->robot).make_ready(request); });
  };
  const auto read = [scene](std::size_t) {
    return seconds_of([&] { benchmark::DoNotOptimize(read_map(scene->map_file)); });
  };
  measurements.push_back({.scene = scene->name,
                          .name = "bricks of a query",
                          .run = fill_bricks,
                          .items = scene->requests.size()});
  measurements.push_back({.scene = scene->name, .name = "map read", .run = read});
}

void add_insertion_measurements(std::vector<Measurement>& measurements) {
  const auto recording = std::make_shared<const Recording>(record_office());
  for (const auto& [resolution_m, resolution] : {std::pair{0.1, "0.1"}, {0.05, "0.05"}}) {
    const auto map = std::make_shared<UncertaintyMap>(resolution_m);
    const auto insert = [recording, map](std::size_t i) {
      if (i == 0) *map = UncertaintyMap(map->resolution_m());
      return seconds_of([&] {
        insert_scan(*map, recording->scans[i], recording->poses_T_map_sensor[i], SensorOptions{});
      });
    };
    const std::string what = std::string("480 x 360 scan inserted at ") + resolution + " m";
    const std::string discretised = what + ", OctoMap, discretised";
    measurements.push_back({.scene = kInsertionScene,
                            .name = what,
                            .run = insert,
                            .items = recording->scans.size(),
                            .baseline = discretised});
    measurements.push_back(octomap_insertion(recording, resolution_m, true, discretised));
    measurements.push_back(
        octomap_insertion(recording, resolution_m, false, what + ", OctoMap, exact"));
  }
}

}  // namespace nbvopt::bench
