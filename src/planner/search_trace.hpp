// What a search evaluated, in order.
#pragma once

#include <limits>
#include <mutex>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// Collects the evaluations of one search. Thread-safe.
class SearchTrace {
 public:
  /// Times count from `begin`.
  explicit SearchTrace(StopRule::Clock::time_point begin) : begin_(begin) {}

  void record(EvaluationKind kind, const JointPosition& joints, double gain);

  std::vector<TracePoint> points() const;

 private:
  const StopRule::Clock::time_point begin_;
  mutable std::mutex mutex_;
  double best_gain_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<TracePoint> points_;
};

}  // namespace nbvopt
