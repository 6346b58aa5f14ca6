#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <optional>
#include <utility>

#include "bench/measurements.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/planner/view_planner.hpp"

namespace nbvopt::bench {
namespace {

using Scene = std::shared_ptr<const BenchScene>;
using Evaluator = std::shared_ptr<const ViewEvaluator>;

constexpr const char* kPaperCode = "paper-code, 48 x 36 rays";
constexpr const char* kPaperCodeQuery = "pan-grid query, paper-code";
constexpr const char* kOneThread = "exact, 48 views of 48 x 36 rays, 1 thread";

double ray_count(const SensorOptions& sensor) {
  return double{1} * sensor.horizontal_rays * sensor.vertical_rays;
}

/// Every view of the scene on its own, on one core. A search evaluates many views from one place:
/// each is evaluated once untimed, so that what it needs is at hand, whatever the evaluator.
Measurement single_views(const Scene& scene, const Evaluator& evaluator, std::string name,
                         const SensorOptions& sensor) {
  const auto evaluate = [scene, evaluator](std::size_t i) {
    const auto once = [&] {
      benchmark::DoNotOptimize(evaluator->evaluate(scene->poses_T_map_sensor[i]));
    };
    once();
    return seconds_of(once);
  };
  return {.scene = scene->name,
          .name = std::move(name),
          .run = evaluate,
          .items = scene->poses_T_map_sensor.size(),
          .rays_an_item = ray_count(sensor),
          .baseline = kPaperCode};
}

/// All views of the scene at once, from place to place.
Measurement all_views(const Scene& scene, const Evaluator& evaluator, std::string name,
                      int threads) {
  const auto evaluate = [scene, evaluator, threads](std::size_t) {
    return seconds_of([&] {
      benchmark::DoNotOptimize(evaluate_views(*evaluator, scene->poses_T_map_sensor, threads));
    });
  };
  const auto views = static_cast<double>(scene->poses_T_map_sensor.size());
  return {.scene = scene->name,
          .name = std::move(name),
          .run = evaluate,
          .rays_an_item = views * ray_count(scene->paper_code_sensor),
          .baseline = kOneThread};
}

/// The paper's pan grid on a map in memory, the grid's bricks included, on one core.
Measurement pan_grid_queries(const Scene& scene, std::string name, const std::string& evaluator) {
  const auto query = [scene, evaluator](std::size_t i) {
    const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
    UncertaintyMap map = read_map(scene->map_file);
    std::optional<ViewPlanner> planner;
    return seconds_of([&] {
      planner.emplace(std::move(map), scene->robot, evaluator);
      benchmark::DoNotOptimize(planner->plan(
          scene->requests[i], nbvopt::Search{.solver = "grid", .grid_steps = {0.8, 0.0, 0.0}}));
    });
  };
  return {.scene = scene->name,
          .name = std::move(name),
          .run = query,
          .items = scene->requests.size(),
          .baseline = kPaperCodeQuery};
}

}  // namespace

void add_view_measurements(const Scene& scene, std::vector<Measurement>& measurements) {
  const SensorOptions& sensor = scene->paper_code_sensor;
  SensorOptions fine_sensor = sensor;
  fine_sensor.horizontal_rays = sensor.horizontal_pixels;
  fine_sensor.vertical_rays = sensor.vertical_pixels;
  const auto grid = VoxelGrid::whole(scene->map);
  const Evaluator exact = make_exact_evaluator(grid, DepthCamera(sensor));

  const Evaluator paper_code = make_paper_code_evaluator(scene->map, sensor);
  measurements.push_back(single_views(scene, paper_code, kPaperCode, sensor));
  for (const SimdLevel level : supported_simd_levels()) {
    measurements.push_back(
        single_views(scene, make_exact_evaluator(grid, DepthCamera(sensor), "paper", level),
                     std::string("exact, 48 x 36 rays, ") + to_string(level), sensor));
  }
  measurements.push_back(
      single_views(scene, make_exact_evaluator(grid, DepthCamera(scene->robot.sensor)),
                   "exact, 48 x 36 rays, as queries cast them", scene->robot.sensor));
  measurements.push_back(single_views(scene, make_exact_evaluator(grid, DepthCamera(fine_sensor)),
                                      "exact, 480 x 360 rays", fine_sensor));
  measurements.push_back(all_views(scene, exact, kOneThread, 1));
  measurements.push_back(all_views(scene, exact, "exact, 48 views of 48 x 36 rays, 2 threads", 2));

  measurements.push_back(pan_grid_queries(scene, kPaperCodeQuery, "paper-code"));
  measurements.push_back(pan_grid_queries(scene, "pan-grid query, exact", "exact"));
}

}  // namespace nbvopt::bench
