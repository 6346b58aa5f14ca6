#include "bench/against_grids.hpp"

#include <algorithm>
#include <array>

#include "bench/formatted.hpp"
#include "bench/search_quality.hpp"

namespace nbvopt::bench {
namespace {

SearchAnswer with_evaluations(const SearchMeasurement& search, std::size_t query,
                              std::int64_t evaluations) {
  StopRule stop;
  stop.max_evaluations = evaluations;
  return answer(*search.scene, search.search, query, stop);
}

SearchAnswer within_time(const SearchMeasurement& search, std::size_t query, double limit_s) {
  const auto limit =
      std::chrono::duration_cast<StopRule::Clock::duration>(std::chrono::duration<double>(limit_s));
  std::array<SearchAnswer, 5> runs;
  for (SearchAnswer& run : runs) {
    StopRule stop;
    stop.deadline = StopRule::Clock::now() + limit;
    run = answer(*search.scene, search.search, query, stop);
  }
  const auto median = runs.begin() + runs.size() / 2;
  std::nth_element(runs.begin(), median, runs.end(),
                   [](const SearchAnswer& a, const SearchAnswer& b) { return a.gain < b.gain; });
  return *median;
}

const char* verdict(double grid, double at_equal_evaluations, double at_equal_time) {
  const bool by_evaluations = at_equal_evaluations > grid;
  const bool by_time = at_equal_time > grid;
  if (by_evaluations && by_time) return "both";
  if (by_evaluations) return "evaluations";
  return by_time ? "time" : "neither";
}

std::string row(const SearchMeasurement& grid, const SearchMeasurement& automatic,
                const std::vector<double>& best) {
  std::vector<SearchAnswer> at_equal_evaluations;
  std::vector<SearchAnswer> at_equal_time;
  for (std::size_t i = 0; i < best.size(); ++i) {
    at_equal_evaluations.push_back(with_evaluations(automatic, i, grid.answers[i].evaluations));
    at_equal_time.push_back(within_time(automatic, i, grid.measurement.best_s[i]));
  }
  const SearchQuality of_grid = quality_of(grid.answers, best);
  const SearchQuality by_evaluations = quality_of(at_equal_evaluations, best);
  const SearchQuality by_time = quality_of(at_equal_time, best);
  return formatted(
      "| %-17s | %-32s | %8.5f | %8.5f | %6.0f | %7.2f | %8.5f | %8.5f | %6.0f | %8.5f | %8.5f |"
      " %7.2f | %-11s |\n",
      grid.measurement.scene.c_str(), grid.search.name.c_str(), of_grid.mean_gain_ratio,
      of_grid.worst_gain_ratio, of_grid.mean_evaluations, grid.measurement.mean_s() * 1e3,
      by_evaluations.mean_gain_ratio, by_evaluations.worst_gain_ratio,
      by_evaluations.mean_evaluations + by_evaluations.mean_surrogate_evaluations,
      by_time.mean_gain_ratio, by_time.worst_gain_ratio, by_time.mean_time_s * 1e3,
      verdict(of_grid.mean_gain_ratio, by_evaluations.mean_gain_ratio, by_time.mean_gain_ratio));
}

}  // namespace

std::string compare_with_grids(const std::vector<SearchMeasurements>& maps) {
  std::string text =
      "| map               | grid                             |   gain / |    worst |  views |     "
      " ms"
      " | auto, as |    worst |  views |  auto in |    worst |      ms | auto better |\n"
      "|                   |                                  |     best |          |        |     "
      "   "
      " |     many |          |        | the time |          |         | at equal    |\n"
      "| ----------------- | -------------------------------- | -------: | -------: | -----: | "
      "------:"
      " | -------: | -------: | -----: | -------: | -------: | ------: | ----------- |\n";
  for (const SearchMeasurements& measurements : maps) {
    const auto automatic = std::find_if(
        measurements.begin(), measurements.end(),
        [](const auto& m) { return m->search.name == kAutoSearch && m->measurement.has_run(); });
    if (automatic == measurements.end()) continue;
    const std::vector<double> best = best_gains(measurements);
    for (const auto& m : measurements) {
      if (m->search.family != kJointGrid || !m->measurement.has_run()) continue;
      text += row(*m, **automatic, best);
    }
  }
  return text;
}

}  // namespace nbvopt::bench
