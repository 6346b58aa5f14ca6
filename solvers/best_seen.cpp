#include "solvers/best_seen.hpp"

#include <cmath>

namespace nbvopt {

void BestSeen::offer(const Point& x, double value) {
  if (!is_better(x, value)) return;
  point_ = x;
  value_ = value;
}

bool BestSeen::is_better(const Point& x, double value) const {
  if (point_.size() == 0) return true;
  if (std::isnan(value)) return false;
  if (std::isnan(value_)) return true;
  if (value > value_) return true;
  if (value < value_) return false;
  return objective_.tie_cost(x) < objective_.tie_cost(point_);
}

}  // namespace nbvopt
