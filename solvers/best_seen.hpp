// The best of the points that a search has evaluated.
#pragma once

#include <limits>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// Keeps the point of the highest value; ties go to the lowest Objective::tie_cost, then to the
/// point offered first. A value that is NaN wins against nothing.
class BestSeen {
 public:
  explicit BestSeen(const Objective& objective) : objective_(objective) {}

  void offer(const Point& x, double value);

  const Point& point() const { return point_; }
  double value() const { return value_; }

 private:
  bool is_better(const Point& x, double value) const;

  const Objective& objective_;
  Point point_;  ///< empty until the first offer
  double value_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace nbvopt
