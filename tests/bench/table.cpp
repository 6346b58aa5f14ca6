#include "bench/table.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <numeric>
#include <optional>

namespace nbvopt::bench {
namespace {

[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...) {
  char buffer[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

double mean_s(const Measurement& m) {
  return std::accumulate(m.best_s.begin(), m.best_s.end(), 0.0) /
         static_cast<double>(m.best_s.size());
}

bool has_run(const Measurement& m) { return m.best_s.front() < 1e9; }

std::string comparison(const Measurement& m, std::span<const Measurement> all) {
  for (const Measurement& baseline : all) {
    const bool is_baseline = baseline.scene == m.scene && baseline.name == m.baseline;
    if (!is_baseline || m.name == baseline.name || !has_run(baseline)) continue;
    const double ratio = mean_s(baseline) / mean_s(m);
    return ratio >= 1.0
               ? formatted("%.2f times as fast as %s", ratio, baseline.name.c_str())
               : formatted("%.2f times the time of %s", 1.0 / ratio, baseline.name.c_str());
  }
  return "";
}

std::string row(const Measurement& m, std::span<const Measurement> all) {
  const double mean = mean_s(m);
  const double longest = *std::max_element(m.best_s.begin(), m.best_s.end());
  std::string text = formatted("| %-15s | %-42s | %8.3f | %8.3f |", m.scene.c_str(), m.name.c_str(),
                               mean * 1e3, longest * 1e3);
  if (m.rays_an_item > 0.0) {
    text +=
        formatted(" %6.1f | %9.1f |", mean / m.rays_an_item * 1e9, m.rays_an_item / mean * 1e-6);
  } else {
    text += "        |           |";
  }
  return text + " " + comparison(m, all) + " |\n";
}

}  // namespace

std::string to_table(std::span<const Measurement> measurements) {
  std::string text =
      "| map             | measured                                   |       ms | slowest  |"
      " ns/ray | Mrays/s   | in this run |\n"
      "| --------------- | ------------------------------------------ | -------: | -------: |"
      " -----: | --------: | --- |\n";
  for (const Measurement& m : measurements) {
    if (has_run(m)) text += row(m, measurements);
  }
  return text;
}

}  // namespace nbvopt::bench
