#include "solvers/batch_search.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <thread>
#include <vector>

#include "solvers/answer.hpp"

namespace nbvopt {
namespace {

/// Evaluates batches of points and keeps the best and the count.
class BatchEvaluator {
 public:
  explicit BatchEvaluator(const Objective& objective) : objective_(objective), best_(objective) {}

  void evaluate(std::span<const Point> points) {
    values_.resize(points.size());
    objective_.values(points, values_);
    for (std::size_t i = 0; i < points.size(); ++i) best_.offer(points[i], values_[i]);
    evaluations_ += static_cast<std::int64_t>(points.size());
  }

  std::int64_t evaluations() const { return evaluations_; }

  SolveResult result(SolveStatus status) const {
    return {status, solve_message(status, evaluations_), best_.point(), best_.value(),
            evaluations_};
  }

 private:
  const Objective& objective_;
  BestSeen best_;
  std::vector<double> values_;
  std::int64_t evaluations_ = 0;
};

}  // namespace

SolveResult batch_search(const Objective& objective, const SolveRequest& request,
                         const CandidateSource& next_candidate, SolveStatus when_spent) {
  const std::int64_t cores = std::max(1U, std::thread::hardware_concurrency());
  BatchEvaluator evaluator(objective);
  std::vector<Point> batch{request.start};
  evaluator.evaluate(batch);

  std::optional<Point> candidate = next_candidate();
  while (candidate) {
    if (const auto status = stop_status(request.stop, evaluator.evaluations())) {
      return evaluator.result(*status);
    }
    const auto batch_limit = static_cast<std::size_t>(
        std::min(cores, request.stop.max_evaluations - evaluator.evaluations()));
    batch.clear();
    while (candidate && batch.size() < batch_limit) {
      batch.push_back(*std::move(candidate));
      candidate = next_candidate();
    }
    evaluator.evaluate(batch);
  }
  return evaluator.result(when_spent);
}

}  // namespace nbvopt
