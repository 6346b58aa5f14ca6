#include "planner/search_trace.hpp"

#include <cmath>

namespace nbvopt {

void SearchTrace::record(EvaluationKind kind, const JointPosition& joints, double gain) {
  const std::scoped_lock lock(mutex_);
  if (kind == EvaluationKind::exact) best_gain_ = std::fmax(best_gain_, gain);
  const std::chrono::duration<double, std::milli> elapsed = StopRule::Clock::now() - begin_;
  points_.push_back({kind, joints, gain, best_gain_, elapsed.count()});
}

std::vector<TracePoint> SearchTrace::points() const {
  const std::scoped_lock lock(mutex_);
  return points_;
}

}  // namespace nbvopt
