// One thing that is measured: a number of items, such as views, each timed on its own.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace nbvopt::bench {

struct Measurement {
  std::string scene;  ///< the map
  std::string name;
  /// Runs one item, 0 <= item < items, and returns what it took, seconds. Items run in order.
  std::function<double(std::size_t item)> run;
  std::size_t items = 1;
  double rays_an_item = 0.0;  ///< 0: no rays to speak of
  std::string baseline{};     ///< the measurement of the same scene to compare with; may be empty

  /// The shortest time of each item so far: on a busy machine the one nearest to the truth.
  std::vector<double> best_s = std::vector<double>(items, std::numeric_limits<double>::infinity());

  bool has_run() const { return best_s.front() < std::numeric_limits<double>::infinity(); }
  double mean_s() const {
    return std::accumulate(best_s.begin(), best_s.end(), 0.0) / static_cast<double>(items);
  }
  double slowest_s() const { return *std::max_element(best_s.begin(), best_s.end()); }
};

/// What a call takes, seconds.
template <typename Call>
double seconds_of(Call&& call) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  call();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace nbvopt::bench
