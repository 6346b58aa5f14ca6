#include "bench/search_measurements.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <utility>

namespace nbvopt::bench {
namespace {

SearchScene make_search_scene(const std::shared_ptr<const BenchScene>& scene) {
  const auto map = std::make_shared<SharedMap>(read_map(scene->map_file));
  map->grid()->read_all();
  return {.scene = scene,
          .planner = ViewPlanner(map, scene->robot),
          .paper_code_planner = ViewPlanner(map, scene->robot, "paper-code")};
}

}  // namespace

SearchAnswer answer(const SearchScene& scene, const Search& search, std::size_t query,
                    const StopRule& stop) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(search.threads));
  const ViewPlanner& planner = search.on_paper_code ? scene.paper_code_planner : scene.planner;
  PlanRequest request = scene.scene->requests[query];
  request.stop = stop;
  PlanResult result;
  const double time_s = seconds_of([&] { result = planner.plan(request, *search.solver); });
  return {.gain = scene.planner.evaluate(result.T_map_sensor).gain,
          .evaluations = result.evaluations,
          .surrogate_evaluations = result.surrogate_evaluations,
          .time_s = time_s};
}

SearchMeasurement::SearchMeasurement(std::shared_ptr<const SearchScene> search_scene,
                                     Search measured_search)
    : scene(std::move(search_scene)),
      search(std::move(measured_search)),
      answers(scene->scene->requests.size()),
      measurement{.scene = scene->scene->name,
                  .name = search.name,
                  .run =
                      [this](std::size_t i) {
                        answers[i] = answer(*scene, search, i);
                        return answers[i].time_s;
                      },
                  .items = answers.size()} {}

SearchMeasurements measure_searches(const std::shared_ptr<const BenchScene>& scene) {
  const auto search_scene = std::make_shared<const SearchScene>(make_search_scene(scene));
  SearchMeasurements measurements;
  for (Search& search : make_searches()) {
    measurements.push_back(std::make_unique<SearchMeasurement>(search_scene, std::move(search)));
  }
  return measurements;
}

std::vector<double> best_gains(const SearchMeasurements& measurements) {
  const BenchScene& scene = *measurements.front()->scene->scene;
  if (!scene.best_gains.empty()) return scene.best_gains;
  std::vector<double> best(scene.requests.size(), 0.0);
  for (const auto& m : measurements) {
    for (std::size_t i = 0; m->measurement.has_run() && i < best.size(); ++i) {
      best[i] = std::max(best[i], m->answers[i].gain);
    }
  }
  return best;
}

}  // namespace nbvopt::bench
