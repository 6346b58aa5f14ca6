#include "solvers/strategy/points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// Values of one coordinate.
using Levels = std::vector<double>;

/// Both ends, or one where both are the same point.
Levels ends(const Objective& objective, Eigen::Index i) {
  const double lower = objective.box().lower[i];
  const double upper = objective.box().upper[i];
  if (lower == upper || objective.period(i) != 0.0) return {lower};
  return {lower, upper};
}

Levels ends_and_centre(const Objective& objective, Eigen::Index i) {
  const double lower = objective.box().lower[i];
  const double upper = objective.box().upper[i];
  Levels levels = ends(objective, i);
  if (lower < upper) levels.push_back(std::midpoint(lower, upper));
  return levels;
}

/// The centre is left out: ends_and_centre() has it.
Levels inside(const Objective& objective, Eigen::Index i, int count) {
  const double lower = objective.box().lower[i];
  const double upper = objective.box().upper[i];
  Levels levels;
  for (int k = 1; k <= count && lower < upper; ++k) {
    if (2 * k == count + 1) continue;
    levels.push_back(std::lerp(lower, upper, k / (count + 1.0)));
  }
  return levels;
}

/// Every combination of the coordinates' values.
void append_combinations(const std::vector<Levels>& levels, std::vector<Point>& points) {
  std::size_t count = 1;
  for (const Levels& coordinate : levels) count *= coordinate.size();
  for (std::size_t number = 0; number < count; ++number) {
    Point& x = points.emplace_back(static_cast<Eigen::Index>(levels.size()));
    std::size_t rest = number;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      x[static_cast<Eigen::Index>(i)] = levels[i][rest % levels[i].size()];
      rest /= levels[i].size();
    }
  }
}

/// The same points, in an order of which every beginning is spread over them: by steps of the
/// golden section.
void spread(std::span<Point> points) {
  const std::size_t count = points.size();
  std::size_t step =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround((std::numbers::phi - 1.0) *
                                                                    static_cast<double>(count))));
  while (std::gcd(step, count) != 1) ++step;
  std::vector<Point> result;
  result.reserve(count);
  for (std::size_t i = 0; i < count; ++i) result.push_back(std::move(points[i * step % count]));
  std::move(result.begin(), result.end(), points.begin());
}

/// Whether the point lies on an edge of the box that runs along coordinate 0.
bool is_on_edge(const Box& box, const Point& x) {
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    if (x[i] != box.lower[i] && x[i] != box.upper[i]) return false;
  }
  return true;
}

/// In the max-norm, in shares of the box's width.
double distance(const Objective& objective, const Eigen::Ref<const Point>& a,
                const Eigen::Ref<const Point>& b) {
  const Box& box = objective.box();
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (box.lower[i] == box.upper[i]) continue;
    double share = std::abs(a[i] - b[i]) / (box.upper[i] - box.lower[i]);
    if (objective.period(i) != 0.0) share = std::min(share, 1.0 - share);
    largest = std::max(largest, share);
  }
  return largest;
}

/// Best first.
std::vector<std::size_t> ranked(std::span<const double> values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  return order;
}

}  // namespace

std::vector<Point> start_points(const Objective& objective, int line_points) {
  const Box& box = objective.box();
  if (const auto free = (box.lower.array() < box.upper.array()).count();
      free > kMostFreeCoordinates) {
    throw UsageError("box: " + std::to_string(free) + " coordinates can move, more than " +
                     std::to_string(kMostFreeCoordinates) +
                     ", of which a strategy samples all corners: freeze some");
  }
  std::vector<Levels> levels;
  for (Eigen::Index i = 0; i < box.dimension(); ++i) {
    levels.push_back(ends_and_centre(objective, i));
    if (i > 0) continue;
    const Levels more = inside(objective, i, line_points);
    levels.front().insert(levels.front().end(), more.begin(), more.end());
  }
  std::vector<Point> points;
  append_combinations(levels, points);
  // A search that must end early should have looked everywhere a little, on edges first.
  const auto inner = std::stable_partition(points.begin(), points.end(),
                                           [&](const Point& x) { return is_on_edge(box, x); });
  spread({points.begin(), inner});
  spread({inner, points.end()});
  return points;
}

std::vector<std::size_t> separate_points(const Objective& objective,
                                         const Eigen::Ref<const Eigen::MatrixXd>& points,
                                         std::span<const double> values, double separation,
                                         std::size_t count) {
  std::vector<std::size_t> chosen;
  for (const std::size_t candidate : ranked(values)) {
    if (chosen.size() == count) break;
    const bool is_crowded = std::any_of(chosen.begin(), chosen.end(), [&](std::size_t better) {
      return distance(objective, points.col(static_cast<Eigen::Index>(candidate)),
                      points.col(static_cast<Eigen::Index>(better))) < separation;
    });
    if (!is_crowded) chosen.push_back(candidate);
  }
  return chosen;
}

}  // namespace nbvopt
