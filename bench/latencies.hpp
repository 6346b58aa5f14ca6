// How long calls took.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "bench/formatted.hpp"

namespace nbvopt::bench {

class Latencies {
 public:
  void add(double elapsed_ms) { elapsed_ms_.push_back(elapsed_ms); }
  std::size_t count() const { return elapsed_ms_.size(); }

  /// The smallest value that this share of all calls does not exceed; there must be a call.
  double quantile_ms(double share) const {
    std::vector<double> sorted = elapsed_ms_;
    const auto last = static_cast<double>(sorted.size() - 1);
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(share * last + 0.5);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  }

  /// A row of a Markdown table: name, calls, median, 99th percentile, longest.
  std::string row(const std::string& name) const {
    if (elapsed_ms_.empty()) return "| " + name + " | 0 | | | |\n";
    return formatted("| %s | %zu | %.2f | %.2f | %.2f |\n", name.c_str(), count(), quantile_ms(0.5),
                     quantile_ms(0.99), quantile_ms(1.0));
  }

  static std::string header() {
    return "| ms | calls | median | 99th percentile | longest |\n| --- | ---: | ---: | ---: | ---: "
           "|\n";
  }

 private:
  std::vector<double> elapsed_ms_;
};

}  // namespace nbvopt::bench
