// Searches measured on the queries of a map: what they find, how soon, and for how many
// evaluations.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "bench/bench_scene.hpp"
#include "bench/measurement.hpp"
#include "bench/searches.hpp"
#include "nbvopt/planner/view_planner.hpp"

namespace nbvopt::bench {

/// A map whose grid of voxels is ready, as a robot's is that asks for view after view.
struct SearchScene {
  std::shared_ptr<const BenchScene> scene;
  ViewPlanner planner;
  ViewPlanner paper_code_planner;
};

/// What a search answered to one query.
struct SearchAnswer {
  double gain = std::numeric_limits<double>::quiet_NaN();  ///< exact, also of paper-code's answer
  std::int64_t evaluations = 0;
  std::int64_t surrogate_evaluations = 0;
  double time_s = std::numeric_limits<double>::quiet_NaN();
};

SearchAnswer answer(const SearchScene& scene, const Search& search, std::size_t query,
                    const StopRule& stop = {});

struct SearchMeasurement {
  SearchMeasurement(std::shared_ptr<const SearchScene> search_scene, Search measured_search);
  // The measurement's run refers to the answers.
  SearchMeasurement(const SearchMeasurement&) = delete;
  SearchMeasurement& operator=(const SearchMeasurement&) = delete;

  std::shared_ptr<const SearchScene> scene;
  Search search;
  std::vector<SearchAnswer> answers;  ///< the last to each query; the same in every repetition
  Measurement measurement;            ///< of every query
};

/// Those of one map.
using SearchMeasurements = std::vector<std::unique_ptr<SearchMeasurement>>;

/// Every search on the map.
SearchMeasurements measure_searches(const std::shared_ptr<const BenchScene>& scene);

/// The gain to compare answers with, a query each: what another program found by brute force or,
/// where there is none, the best that any of these searches found.
std::vector<double> best_gains(const SearchMeasurements& measurements);

}  // namespace nbvopt::bench
