// What stands between an objective and a third-party solver.
#pragma once

#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <string>

#include "nbvopt/solver/solver.hpp"
#include "solvers/answer.hpp"

namespace nbvopt {

/// All that is known of the objective at one point.
struct Evaluation {
  Point x;
  double value = std::numeric_limits<double>::quiet_NaN();
  Point gradient;             ///< only where asked for
  Eigen::VectorXd residuals;  ///< only where asked for
  Eigen::MatrixXd jacobian;   ///< dr/dx, with the residuals
};

/// Keeps the contract of an answer whatever a third-party solver does: counts evaluations, keeps
/// the best point, evaluates nothing once the stop rule holds, and carries exceptions past code
/// that would lose them. Used by one thread.
class TrackedObjective {
 public:
  /// Evaluates the start, whatever the stop rule says. `needs` tells what to evaluate.
  TrackedObjective(const Objective& objective, const SolveRequest& request, SolverNeeds needs);

  /// The evaluation at a point of the box, or null: the search must end. Asking for the same point
  /// twice in a row, the start to begin with, costs nothing. Never throws: what the objective
  /// throws ends the search.
  const Evaluation* evaluate(const Point& x) noexcept;

  /// True once evaluate() has returned null.
  bool is_stopped() const { return stopped_.has_value() || exception_ != nullptr; }

  /// The best point. The status is `otherwise` unless the stop rule ended the search; `detail`, the
  /// solver's own words, is then added to the message. Throws what the objective threw.
  SolveResult result(SolveStatus otherwise, const std::string& detail = {}) const;

 private:
  void evaluate_at(const Point& x);

  const Objective& objective_;
  StopRule stop_;
  SolverNeeds needs_;
  BestSeen best_;
  Evaluation last_;
  std::int64_t evaluations_ = 0;
  std::optional<SolveStatus> stopped_;
  std::exception_ptr exception_;
};

}  // namespace nbvopt
