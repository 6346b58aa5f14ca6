#include "solvers/tracked_objective.hpp"

#include "solvers/answer.hpp"

namespace nbvopt {

TrackedObjective::TrackedObjective(const Objective& objective, const SolveRequest& request,
                                   SolverNeeds needs)
    : objective_(objective), stop_(request.stop), needs_(needs), best_(objective) {
  evaluate_at(request.start);
}

const Evaluation* TrackedObjective::evaluate(const Point& x) noexcept {
  if (is_stopped()) return nullptr;
  if (x == last_.x) return &last_;
  stopped_ = stop_status(stop_, evaluations_);
  if (stopped_) return nullptr;
  try {
    evaluate_at(x);
  } catch (...) {
    exception_ = std::current_exception();
    return nullptr;
  }
  return &last_;
}

SolveResult TrackedObjective::result(SolveStatus otherwise, const std::string& detail) const {
  if (exception_) std::rethrow_exception(exception_);
  const SolveStatus status = stopped_.value_or(otherwise);
  std::string message = solve_message(status, evaluations_);
  if (!stopped_ && !detail.empty()) message += " (" + detail + ")";
  return {status, message, best_.point(), best_.value(), evaluations_};
}

void TrackedObjective::evaluate_at(const Point& x) {
  last_.x = x;
  if (needs_.residuals) {
    last_.value = objective_.value_and_residuals(x, last_.residuals, &last_.jacobian);
  } else if (needs_.gradient) {
    last_.value = objective_.value_and_gradient(x, last_.gradient);
  } else {
    last_.value = objective_.value(x);
  }
  ++evaluations_;
  best_.offer(x, last_.value);
}

}  // namespace nbvopt
