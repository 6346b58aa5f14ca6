#include "bench/hard_cases.hpp"

#include <tbb/global_control.h>

#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/chamber.hpp"
#include "bench/formatted.hpp"
#include "bench/measurement.hpp"
#include "bench/search_quality.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "support/paths.hpp"

namespace nbvopt::bench {
namespace {

/// "office_partial.ot", or "chamber 77026".
std::string place_of(const nlohmann::json& hard) {
  if (hard.contains("map")) return hard.at("map");
  return "chamber " + std::to_string(hard.at("chamber").get<std::uint64_t>());
}

UncertaintyMap map_of(const nlohmann::json& hard) {
  if (hard.contains("map")) return read_map(test::datasets_dir() / hard.at("map"));
  return make_chamber(hard.at("chamber"));
}

PlanRequest request_of(const nlohmann::json& hard) {
  const nlohmann::json& base = hard.at("base");
  PlanRequest request;
  request.T_map_base = base_pose(base.at("x"), base.at("y"), base.at("z"), base.at("yaw"));
  request.joints = {hard.at("pan"), hard.at("tilt"), hard.at("height")};
  request.motion_time_s = hard.at("time_budget_s");
  request.min_gain = 0.0;
  return request;
}

}  // namespace

std::string measure_hard_cases() {
  const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
  std::ifstream in(test::datasets_dir() / "hard" / "cases.json");
  const nlohmann::json cases = nlohmann::json::parse(in).at("cases");
  std::map<std::string, ViewPlanner> planners;
  std::vector<SearchAnswer> answers;
  std::vector<double> best_gains;
  std::string rows;
  for (const nlohmann::json& hard : cases) {
    const std::string place = place_of(hard);
    if (!planners.contains(place)) planners.emplace(place, ViewPlanner(map_of(hard), Robot{}));
    const ViewPlanner& planner = planners.at(place);
    const PlanRequest request = request_of(hard);
    planner.make_ready(request);
    PlanResult result;
    const double time_s = seconds_of([&] { result = planner.plan(request); });
    answers.push_back({.gain = result.view.gain,
                       .evaluations = result.evaluations,
                       .surrogate_evaluations = result.surrogate_evaluations,
                       .time_s = time_s});
    best_gains.push_back(hard.at("best_gain"));
    rows += formatted("| %-17s | %6.1f | %9.1f | %8.4f | %8.2f | %-8s |\n", place.c_str(),
                      request.motion_time_s, best_gains.back(),
                      gain_ratio(answers.back().gain, best_gains.back()), time_s * 1e3,
                      hard.at("lost_to").get<std::string>().c_str());
  }
  const SearchQuality all = quality_of(answers, best_gains);
  return "| hard start        | time s | best gain | auto     |       ms | lost to  |\n"
         "| ----------------- | -----: | --------: | -------: | -------: | -------- |\n" +
         rows +
         formatted(
             "auto on %zu hard starts: %.4f of the best in the mean, %.4f at worst, %.2f ms\n",
             answers.size(), all.mean_gain_ratio, all.worst_gain_ratio, all.mean_time_s * 1e3);
}

}  // namespace nbvopt::bench
