#include "solvers/answer.hpp"

#include <algorithm>
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

std::optional<SolveStatus> stop_status(const StopRule& stop, std::int64_t evaluations) {
  if (stop.cancel.is_cancelled()) return SolveStatus::cancelled;
  if (evaluations >= stop.max_evaluations) return SolveStatus::evaluation_limit;
  if (stop.is_expired()) return SolveStatus::time_limit;
  return std::nullopt;
}

SolveRequest bounded(const SolveRequest& request, Eigen::Index free_dimension) {
  SolveRequest result = request;
  if (request.stop.max_evaluations == StopRule{}.max_evaluations) {
    result.stop.max_evaluations = std::max<std::int64_t>(1, kDefaultEvaluations * free_dimension);
  }
  return result;
}

std::string solve_message(SolveStatus status, std::int64_t evaluations) {
  const std::string count =
      std::to_string(evaluations) + (evaluations == 1 ? " evaluation" : " evaluations");
  switch (status) {
    case SolveStatus::not_run:
      return "the solver was not called";
    case SolveStatus::converged:
      return "tolerances met after " + count;
    case SolveStatus::stalled:
      return "no progress, tolerances not met, after " + count;
    case SolveStatus::grid_complete:
      return "every candidate evaluated, " + count;
    case SolveStatus::evaluation_limit:
      return "evaluation limit reached after " + count;
    case SolveStatus::time_limit:
      return "time limit reached after " + count;
    case SolveStatus::cancelled:
      return "cancelled after " + count;
  }
  return to_string(status);
}

}  // namespace nbvopt
