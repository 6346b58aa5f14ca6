#include <benchmark/benchmark.h>

#include <utility>

#include "bench/measurements.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "office_scene.hpp"
#include "simulated_scan.hpp"

namespace nbvopt::bench {
namespace {

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
    measurements.push_back({.scene = "office, growing",
                            .name = std::string("480 x 360 scan inserted at ") + resolution + " m",
                            .run = insert,
                            .items = recording->scans.size()});
  }
}

}  // namespace nbvopt::bench
