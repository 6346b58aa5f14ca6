#include "solvers/strategy/separate_points.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {
namespace {

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
