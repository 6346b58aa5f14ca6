#include "study/evaluate/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "study/evaluate/ratio.hpp"

namespace nbvopt::study {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Sums {
  std::size_t runs = 0;
  std::size_t answers = 0;
  double gain = 0.0;
  double added = 0.0;  ///< more than staying gains
  double move_time_s = 0.0;
  double moving_s = 0.0;   ///< computing and moving
  double waiting_s = 0.0;  ///< computing and waiting for the end of the motion time

  void add(const Run& run, double motion_time_s) {
    const double search_s = run.search_time_ms / 1000.0;
    ++runs;
    waiting_s += search_s + motion_time_s;
    if (run.has_failed()) {
      moving_s += search_s + motion_time_s;
      return;
    }
    ++answers;
    gain += run.gain;
    added += run.gain - run.current_gain;
    move_time_s += run.move_time_s;
    moving_s += search_s + run.move_time_s;
  }

  Cycle cycle(std::size_t solver, double motion_time_s) const {
    const auto rate = [](double sum, double time_s) { return time_s > 0.0 ? sum / time_s : kNaN; };
    const double slots_s = motion_time_s > 0.0 ? waiting_s : kNaN;
    return {.solver = solver,
            .motion_time_s = motion_time_s,
            .runs = runs,
            .mean_gain = gain / static_cast<double>(runs),
            .mean_move_time_s = move_time_s / static_cast<double>(answers),
            .gain_per_s_moving = rate(gain, moving_s),
            .gain_per_s_waiting = rate(gain, slots_s),
            .added_per_s_waiting = rate(added, slots_s)};
  }
};

std::vector<std::string> maps_of(const Results& results) {
  std::vector<std::string> maps;
  std::set<std::string> seen;
  for (const CaseResult& one : results.cases) {
    if (seen.insert(one.map).second) maps.push_back(one.map);
  }
  return maps;
}

/// The motion time of the cycle with the greatest figure.
double best_of(const std::vector<Cycle>& cycles, double Cycle::*figure) {
  double best = kNaN;
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Cycle& cycle : cycles) {
    if (!(cycle.*figure > greatest)) continue;  // nor where it is NaN
    greatest = cycle.*figure;
    best = cycle.motion_time_s;
  }
  return best;
}

}  // namespace

std::vector<Cycle> cycles(const Results& results) {
  std::map<std::pair<std::size_t, double>, Sums> sums;
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    for (const CaseResult& one : results.cases) sums[{solver, one.motion_time_s}];
  }
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.budget != budget) continue;
    const double motion_time_s = results.cases[run.case_index].motion_time_s;
    sums[{run.solver, motion_time_s}].add(run, motion_time_s);
  }
  std::vector<Cycle> rows;
  for (const auto& [key, own] : sums) rows.push_back(own.cycle(key.first, key.second));
  return rows;
}

std::vector<BestMotionTime> best_motion_times(const Results& results) {
  std::map<std::pair<std::size_t, std::string>, std::map<double, Sums>> sums;
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.budget != budget) continue;
    const CaseResult& one = results.cases[run.case_index];
    sums[{run.solver, one.map}][one.motion_time_s].add(run, one.motion_time_s);
  }
  const std::vector<std::string> maps = maps_of(results);
  std::vector<BestMotionTime> rows;
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    for (const std::string& map : maps) {
      std::vector<Cycle> own;
      for (const auto& [motion_time_s, sum] : sums[{solver, map}]) {
        own.push_back(sum.cycle(solver, motion_time_s));
      }
      rows.push_back({.solver = solver,
                      .map = map,
                      .moving_s = best_of(own, &Cycle::gain_per_s_moving),
                      .waiting_s = best_of(own, &Cycle::gain_per_s_waiting),
                      .adding_s = best_of(own, &Cycle::added_per_s_waiting)});
    }
  }
  return rows;
}

}  // namespace nbvopt::study
