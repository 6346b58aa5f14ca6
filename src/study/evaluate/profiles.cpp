#include "study/evaluate/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "study/evaluate/ratio.hpp"
#include "study/evaluate/running_time.hpp"

namespace nbvopt::study {
namespace {

/// Staying may cost nothing at all; ratios of costs and logarithmic axes need something.
constexpr double kLeastEvaluations = 1.0;
constexpr double kLeastTime_ms = 1e-3;

struct Answer {
  std::size_t solver = 0;
  std::optional<Cost> cost;
};

std::optional<Cost> positive_cost(const Results& results, const Run& run, double target) {
  std::optional<Cost> cost = cost_to_reach(results, run, target);
  if (!cost) return std::nullopt;
  return Cost{std::max(cost->evaluations, kLeastEvaluations),
              std::max(cost->time_ms, kLeastTime_ms)};
}

std::vector<const Run*> comparable_runs(const Results& results) {
  const std::size_t budget = loosest_budget(results);
  std::vector<const Run*> runs;
  for (const Run& run : results.runs) {
    if (run.budget == budget && has_reference(results, run)) runs.push_back(&run);
  }
  return runs;
}

Cost least_cost(const std::vector<Answer>& answers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Cost least{kInfinity, kInfinity};
  for (const Answer& answer : answers) {
    if (!answer.cost) continue;
    least.evaluations = std::min(least.evaluations, answer.cost->evaluations);
    least.time_ms = std::min(least.time_ms, answer.cost->time_ms);
  }
  return least;
}

void add(SolverProfiles& profiles, const std::optional<Cost>& cost, const Cost& unit) {
  ++profiles.evaluations.questions;
  ++profiles.time_ms.questions;
  if (!cost) return;
  profiles.evaluations.costs.push_back(cost->evaluations / unit.evaluations);
  profiles.time_ms.costs.push_back(cost->time_ms / unit.time_ms);
}

void sort(std::vector<SolverProfiles>& all) {
  for (SolverProfiles& profiles : all) {
    std::ranges::sort(profiles.evaluations.costs);
    std::ranges::sort(profiles.time_ms.costs);
  }
}

}  // namespace

double Profile::share_within(double cost) const {
  const auto end = std::ranges::upper_bound(costs, cost);
  return static_cast<double>(end - costs.begin()) / static_cast<double>(questions);
}

double Profile::share_answered() const {
  return static_cast<double>(costs.size()) / static_cast<double>(questions);
}

std::vector<SolverProfiles> performance_profiles(const Results& results, double target) {
  std::map<std::pair<std::size_t, std::uint64_t>, std::vector<Answer>> questions;
  for (const Run* run : comparable_runs(results)) {
    questions[{run->case_index, run->seed}].push_back(
        {run->solver, positive_cost(results, *run, target)});
  }
  std::vector<SolverProfiles> all(results.solvers.size());
  for (const auto& [question, answers] : questions) {
    const Cost least = least_cost(answers);
    for (const Answer& answer : answers) add(all[answer.solver], answer.cost, least);
  }
  sort(all);
  return all;
}

std::vector<double> data_profile_targets() {
  constexpr int kTargets = 41;
  constexpr double kMostMissed = 0.3;
  constexpr double kLeastMissed = 0.001;
  std::vector<double> targets;
  for (int i = 0; i < kTargets; ++i) {
    const double way = i / (kTargets - 1.0);
    targets.push_back(1.0 - kMostMissed * std::pow(kLeastMissed / kMostMissed, way));
  }
  return targets;
}

std::vector<SolverProfiles> data_profiles(const Results& results,
                                          const std::vector<double>& targets) {
  std::vector<SolverProfiles> all(results.solvers.size());
  for (const Run* run : comparable_runs(results)) {
    for (const double target : targets) {
      add(all[run->solver], positive_cost(results, *run, target), {1.0, 1.0});
    }
  }
  sort(all);
  return all;
}

std::array<double, 2> cost_range(const std::vector<SolverProfiles>& profiles,
                                 Profile SolverProfiles::*unit) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const SolverProfiles& own : profiles) {
    const std::vector<double>& costs = (own.*unit).costs;
    if (costs.empty()) continue;
    least = std::min(least, costs.front());
    most = std::max(most, costs.back());
  }
  if (most == 0.0) return {1.0, 1.0};
  return {least, most};
}

}  // namespace nbvopt::study
