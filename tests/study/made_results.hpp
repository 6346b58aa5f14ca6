// Results made up by a test.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "study/results.hpp"

namespace nbvopt::study {

/// An answer that reached `gain` in one step, at its end.
struct MadeRun {
  std::size_t case_index = 0;
  std::size_t solver = 0;
  double gain = 0.0;
  std::int64_t evaluations = 10;
  double time_ms = 1.0;
  std::uint64_t seed = 1;
  std::size_t budget = 0;
};

inline Run made_run(const MadeRun& made) {
  Run run;
  run.case_index = made.case_index;
  run.solver = made.solver;
  run.budget = made.budget;
  run.seed = made.seed;
  run.gain = made.gain;
  run.evaluations = made.evaluations;
  run.move_time_s = 0.5;
  run.search_time_ms = made.time_ms;
  return run;
}

inline Run failed_run(const MadeRun& made) {
  Run run = made_run(made);
  run.failure = "out of memory";
  run.gain = 0.0;
  return run;
}

/// As many cases as references, in one map, all with the motion time 1 s.
inline Results made_results(std::vector<std::string> solvers,
                            const std::vector<double>& references) {
  Results results;
  results.study = "made";
  results.solvers = std::move(solvers);
  results.budgets = {{.max_evaluations = 100, .time_limit_ms = 0.0}};
  for (std::size_t i = 0; i < references.size(); ++i) {
    results.cases.push_back({.map = "room.ot",
                             .start = i,
                             .motion_time_s = 1.0,
                             .mode = UncertaintyMode::both,
                             .reference_gain = references[i]});
  }
  return results;
}

inline void sort_runs(Results& results) {
  std::ranges::sort(results.runs, {}, [](const Run& run) {
    return std::tuple(run.case_index, run.solver, run.budget, run.seed);
  });
}

}  // namespace nbvopt::study
