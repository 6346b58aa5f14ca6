#include "bench/search_report.hpp"

#include <nlohmann/json.hpp>

#include "bench/formatted.hpp"
#include "bench/search_quality.hpp"

namespace nbvopt::bench {
namespace {

/// The mean time against that of the paper's search on the same map; empty where that did not run.
std::string time_ratio(const Measurement& m, const SearchMeasurements& measurements) {
  for (const auto& paper : measurements) {
    if (paper->search.name != kPaperSearch || !paper->measurement.has_run()) continue;
    return formatted("%.3f", m.mean_s() / paper->measurement.mean_s());
  }
  return "";
}

std::string row(const SearchMeasurement& m, const SearchMeasurements& measurements) {
  const SearchQuality quality = quality_of(m.answers, best_gains(measurements));
  return formatted("| %-17s | %-40s | %8.5f | %8.5f | %8.2f | %8.2f | %8.0f | %9.0f | %10s |\n",
                   m.measurement.scene.c_str(), m.search.name.c_str(), quality.mean_gain_ratio,
                   quality.worst_gain_ratio, m.measurement.mean_s() * 1e3,
                   m.measurement.slowest_s() * 1e3, quality.mean_evaluations,
                   quality.mean_surrogate_evaluations,
                   time_ratio(m.measurement, measurements).c_str());
}

}  // namespace

std::string to_table(const std::vector<SearchMeasurements>& maps) {
  std::string text =
      "| map               | search                                   |   gain / |    worst |"
      "       ms |  slowest |    views | surrogate | time /     |\n"
      "|                   |                                          |     best |          |"
      "          |          |          |     views | paper-code |\n"
      "| ----------------- | ---------------------------------------- | -------: | -------: |"
      " -------: | -------: | -------: | --------: | ---------: |\n";
  for (const SearchMeasurements& measurements : maps) {
    for (const auto& m : measurements) {
      if (m->measurement.has_run()) text += row(*m, measurements);
    }
  }
  return text;
}

std::string to_json_lines(const std::vector<SearchMeasurements>& maps) {
  std::string lines;
  for (const SearchMeasurements& measurements : maps) {
    const std::vector<double> best = best_gains(measurements);
    for (const auto& m : measurements) {
      for (std::size_t i = 0; m->measurement.has_run() && i < m->answers.size(); ++i) {
        const SearchAnswer& answer = m->answers[i];
        const nlohmann::ordered_json line{{"map", m->measurement.scene},
                                          {"search", m->search.name},
                                          {"family", m->search.family},
                                          {"threads", m->search.threads},
                                          {"query", i},
                                          {"gain", answer.gain},
                                          {"best_gain", best[i]},
                                          {"gain_ratio", gain_ratio(answer.gain, best[i])},
                                          {"time_ms", m->measurement.best_s[i] * 1e3},
                                          {"evaluations", answer.evaluations},
                                          {"surrogate_evaluations", answer.surrogate_evaluations}};
        lines += line.dump() + '\n';
      }
    }
  }
  return lines;
}

}  // namespace nbvopt::bench
