#include "nbvopt/solver/solver.hpp"

#include <cmath>
#include <sstream>

#include "core/enum_names.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<SolveStatus> = std::to_array<EnumName<SolveStatus>>({
    {SolveStatus::not_run, "not_run"},
    {SolveStatus::converged, "converged"},
    {SolveStatus::stalled, "stalled"},
    {SolveStatus::grid_complete, "grid_complete"},
    {SolveStatus::evaluation_limit, "evaluation_limit"},
    {SolveStatus::time_limit, "time_limit"},
    {SolveStatus::cancelled, "cancelled"},
});

namespace {

std::string coordinate_text(const char* name, Eigen::Index i, double value) {
  std::ostringstream text;
  text.precision(17);
  text << name << "[" << i << "] = " << value;
  return text.str();
}

void check_box(const Box& box) {
  if (box.lower.size() == 0 || box.lower.size() != box.upper.size()) {
    throw UsageError("box: give a lower and an upper bound for at least one coordinate");
  }
  for (Eigen::Index i = 0; i < box.dimension(); ++i) {
    if (!std::isfinite(box.lower[i])) {
      throw UsageError(coordinate_text("box: lower", i, box.lower[i]) + " must be finite");
    }
    if (!std::isfinite(box.upper[i])) {
      throw UsageError(coordinate_text("box: upper", i, box.upper[i]) + " must be finite");
    }
    if (box.lower[i] > box.upper[i]) {
      throw UsageError(coordinate_text("box: lower", i, box.lower[i]) + " must not exceed " +
                       coordinate_text("upper", i, box.upper[i]));
    }
  }
}

void check_start(const Point& start, const Box& box) {
  if (start.size() != box.dimension()) {
    throw UsageError("start: has " + std::to_string(start.size()) + " coordinates, the box has " +
                     std::to_string(box.dimension()));
  }
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    // Written so that NaN fails.
    if (!(start[i] >= box.lower[i] && start[i] <= box.upper[i])) {
      throw UsageError(coordinate_text("start", i, start[i]) + " must lie in the box, between " +
                       coordinate_text("lower", i, box.lower[i]) + " and " +
                       coordinate_text("upper", i, box.upper[i]));
    }
  }
}

}  // namespace

std::string to_string(SolveStatus value) { return std::string(enum_name(value)); }

SolveResult Solver::solve(const Objective& objective, const SolveRequest& request) const {
  check_box(objective.box());
  check_start(request.start, objective.box());
  if (request.stop.max_evaluations < 1) {
    throw UsageError("max_evaluations = " + std::to_string(request.stop.max_evaluations) +
                     ": at least 1 is needed, for the start");
  }
  check_needs(objective);
  return do_solve(objective, request);
}

void Solver::check_needs(const Objective& objective) const {
  const auto check = [&](bool is_met, const std::string& need) {
    if (is_met) return;
    throw UsageError("solver " + name() + " needs " + need +
                     ", which this objective has not: use a solver that needs none");
  };
  check(!needs().gradient || objective.has_gradient(), "a gradient");
  check(!needs().residuals || objective.has_residuals(), "residuals");
  check(!needs().surrogate || objective.surrogate(), "a surrogate");
}

}  // namespace nbvopt
