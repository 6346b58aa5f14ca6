#include "bench/table.hpp"

#include "bench/formatted.hpp"

namespace nbvopt::bench {
namespace {

std::string comparison(const Measurement& m, std::span<const Measurement> all) {
  for (const Measurement& baseline : all) {
    const bool is_baseline = baseline.scene == m.scene && baseline.name == m.baseline;
    if (!is_baseline || m.name == baseline.name || !baseline.has_run()) continue;
    const double ratio = baseline.mean_s() / m.mean_s();
    return ratio >= 1.0
               ? formatted("%.2f times as fast as %s", ratio, baseline.name.c_str())
               : formatted("%.2f times the time of %s", 1.0 / ratio, baseline.name.c_str());
  }
  return "";
}

std::string row(const Measurement& m, std::span<const Measurement> all) {
  const double mean_s = m.mean_s();
  std::string text = formatted("| %-15s | %-42s | %8.3f | %8.3f |", m.scene.c_str(), m.name.c_str(),
                               mean_s * 1e3, m.slowest_s() * 1e3);
  if (m.rays_an_item > 0.0) {
    text += formatted(" %6.1f | %9.1f |", mean_s / m.rays_an_item * 1e9,
                      m.rays_an_item / mean_s * 1e-6);
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
    if (m.has_run()) text += row(m, measurements);
  }
  return text;
}

}  // namespace nbvopt::bench
