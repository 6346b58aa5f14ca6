// The interface of all solvers.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

enum class SolveStatus {
  not_run,
  converged,      ///< the solver's own tolerances were met
  stalled,        ///< the solver gave up before its tolerances were met, such as on NaN
  grid_complete,  ///< every candidate was evaluated
  evaluation_limit,
  time_limit,
  cancelled,
};
std::string to_string(SolveStatus status);

/// What a solver needs of an objective.
struct SolverNeeds {
  bool gradient = false;
  bool residuals = false;
  bool surrogate = false;
};

/// One search: where it starts, when it stops, its seed. Without an evaluation limit every solver
/// but `grid` and strategies sets its own, 200 a coordinate that is not frozen; a grid ends by
/// itself, and a strategy's stages have their own limits.
struct SolveRequest {
  Point start;  ///< inside the box; always evaluated
  StopRule stop;
  std::uint64_t seed = 1;
};

/// The best point that was evaluated; born as "not run".
struct SolveResult {
  SolveStatus status = SolveStatus::not_run;
  std::string message = "the solver was not called";
  Point best;
  double value = std::numeric_limits<double>::quiet_NaN();
  std::int64_t evaluations = 0;            ///< of the objective
  std::int64_t surrogate_evaluations = 0;  ///< of its surrogate, by strategies
};

/// A maximiser over a box. The answer lies in the box, is never worse than the start nor than any
/// point evaluated (NaN is worse than any value), and is the same for the same request, whatever
/// the number of threads. An exception of the objective comes through as it is.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual std::string name() const = 0;
  virtual SolverNeeds needs() const { return {}; }

  /// Checks, then solves. Throws UsageError when the start is not in the box, bounds are crossed
  /// or not finite, the evaluation limit leaves none for the start, or the objective lacks what
  /// the solver needs. A deadline in the past or a raised cancel flag returns the start, evaluated.
  SolveResult solve(const Objective& objective, const SolveRequest& request) const;

  /// Throws UsageError when the objective lacks what the solver needs; part of solve().
  void check_needs(const Objective& objective) const;

 private:
  virtual SolveResult do_solve(const Objective& objective, const SolveRequest& request) const = 0;
};

}  // namespace nbvopt
