// The exact gain over the mast's box, as solvers see it.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/planner/planner.hpp"
#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// gain(pan, tilt, height) of one request. Counts its evaluations and remembers the last views, so
/// that the answer's view is not evaluated twice. Thread-safe.
class ViewObjective final : public Objective {
 public:
  /// All references must outlive the objective. `joints` is where the mast is.
  ViewObjective(const PlanRequest& request, const Mast& mast, const JointPosition& joints,
                const JointBox& box, const ViewEvaluator& evaluator);

  const Box& box() const override { return box_; }
  double value(const Point& x) const override;
  void values(std::span<const Point> points, std::span<double> values) const override;
  double tie_cost(const Point& x) const override;

  /// The view at a point, evaluated unless it is remembered.
  ViewGain view(const Point& x) const;

  std::int64_t evaluations() const { return evaluations_; }

 private:
  struct Remembered {
    Point point;
    ViewGain view;
  };

  Transform pose(const Point& x) const;
  void remember(const Point& x, const ViewGain& view) const;

  const PlanRequest& request_;
  const Mast& mast_;
  JointPosition joints_;
  Box box_;
  const ViewEvaluator& evaluator_;
  mutable std::atomic<std::int64_t> evaluations_ = 0;
  mutable std::mutex mutex_;
  mutable std::optional<Remembered> start_;  ///< where the mast is
  mutable std::optional<Remembered> best_;
};

}  // namespace nbvopt
