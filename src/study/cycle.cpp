#include "study/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "study/ratio.hpp"
#include "study/sample.hpp"

namespace nbvopt::study {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double gain_per_s(double gain, double motion_s, double search_time_ms) {
  return gain / (motion_s + search_time_ms / 1000.0);
}

struct Samples {
  std::vector<double> gain;
  std::vector<double> move_time_s;
  std::vector<double> moving;
  std::vector<double> waiting;

  void add(const Run& run, double motion_time_s) {
    const bool has_end = motion_time_s > 0.0;
    if (run.has_failed()) {
      gain.push_back(0.0);
      moving.push_back(0.0);
      if (has_end) waiting.push_back(0.0);
      return;
    }
    gain.push_back(run.gain);
    move_time_s.push_back(run.move_time_s);
    if (run.move_time_s + run.search_time_ms > 0.0) {
      moving.push_back(gain_per_s(run.gain, run.move_time_s, run.search_time_ms));
    }
    if (has_end) waiting.push_back(gain_per_s(run.gain, motion_time_s, run.search_time_ms));
  }

  Cycle cycle(std::size_t solver, double motion_time_s) const {
    return {.solver = solver,
            .motion_time_s = motion_time_s,
            .runs = gain.size(),
            .mean_gain = mean(gain),
            .mean_move_time_s = mean(move_time_s),
            .gain_per_s_moving = mean(moving),
            .gain_per_s_waiting = mean(waiting)};
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
  std::map<std::pair<std::size_t, double>, Samples> samples;
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    for (const CaseResult& one : results.cases) samples[{solver, one.motion_time_s}];
  }
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.budget != budget) continue;
    const double motion_time_s = results.cases[run.case_index].motion_time_s;
    samples[{run.solver, motion_time_s}].add(run, motion_time_s);
  }
  std::vector<Cycle> rows;
  for (const auto& [key, own] : samples) rows.push_back(own.cycle(key.first, key.second));
  return rows;
}

std::vector<BestMotionTime> best_motion_times(const Results& results) {
  std::map<std::pair<std::size_t, std::string>, std::map<double, Samples>> samples;
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.budget != budget) continue;
    const CaseResult& one = results.cases[run.case_index];
    samples[{run.solver, one.map}][one.motion_time_s].add(run, one.motion_time_s);
  }
  const std::vector<std::string> maps = maps_of(results);
  std::vector<BestMotionTime> rows;
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    for (const std::string& map : maps) {
      std::vector<Cycle> own;
      for (const auto& [motion_time_s, sample] : samples[{solver, map}]) {
        own.push_back(sample.cycle(solver, motion_time_s));
      }
      rows.push_back({.solver = solver,
                      .map = map,
                      .moving_s = best_of(own, &Cycle::gain_per_s_moving),
                      .waiting_s = best_of(own, &Cycle::gain_per_s_waiting)});
    }
  }
  return rows;
}

}  // namespace nbvopt::study
