#include "nbvopt/sim/information_growth.hpp"

#include <algorithm>
#include <iterator>

namespace nbvopt {

std::optional<double> InformationGrowth::time_to_s(double information) const {
  const auto reached = std::ranges::find_if(
      points_, [&](const Point& point) { return point.information >= information; });
  if (reached == points_.end()) return std::nullopt;
  return reached->time_s;
}

double InformationGrowth::at(double time_s) const {
  const auto later = std::ranges::upper_bound(points_, time_s, {}, &Point::time_s);
  return later == points_.begin() ? 0.0 : std::prev(later)->information;
}

double InformationGrowth::mean_until(double duration_s) const {
  if (!(duration_s > 0.0)) return 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double until_s = i + 1 < points_.size() ? points_[i + 1].time_s : duration_s;
    area +=
        points_[i].information * std::max(0.0, std::min(until_s, duration_s) - points_[i].time_s);
  }
  return area / duration_s;
}

InformationGrowth InformationGrowth::thinned(std::size_t count) const {
  if (points_.size() <= count) return *this;
  InformationGrowth thin;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * (points_.size() - 1) / (count - 1);
    thin.points_.push_back(points_[at]);
  }
  return thin;
}

}  // namespace nbvopt
