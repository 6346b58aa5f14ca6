// What the answers of all solvers share: the best point seen, why a search must end, and how a user
// is told.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "nbvopt/solver/solver.hpp"

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

/// The reason to stop before another evaluation; nothing while the search may go on.
std::optional<SolveStatus> stop_status(const StopRule& stop, std::int64_t evaluations);

/// Evaluations for each coordinate that is not frozen, where the request sets no limit.
inline constexpr std::int64_t kDefaultEvaluations = 200;

/// The request with an evaluation limit, the default one where it has none: every search ends.
SolveRequest bounded(const SolveRequest& request, Eigen::Index free_dimension);

/// One line in plain words.
std::string solve_message(SolveStatus status, std::int64_t evaluations);

}  // namespace nbvopt
