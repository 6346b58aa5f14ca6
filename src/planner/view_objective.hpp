// The exact gain over the mast's box, as solvers see it.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>

#include "nbvopt/gain/view_evaluator.hpp"
#include "planner/joint_objective.hpp"
#include "planner/search_trace.hpp"

namespace nbvopt {

/// gain(pan, tilt, height) once the joints have arrived. Counts its evaluations and remembers the
/// last views, so that the answer's view is not evaluated twice. Thread-safe.
class ViewObjective final : public JointObjective {
 public:
  /// All references must outlive the objective. `surrogate` may be null: there is none; `trace` may
  /// be null: nothing is recorded.
  ViewObjective(const MovingMast& mast, const SensorOptions& sensor, const JointBox& box,
                const ViewEvaluator& evaluator, const Objective* surrogate, SearchTrace* trace);

  double value(const Point& x) const override;
  /// On all cores; recorded in the order of the points.
  void values(std::span<const Point> points, std::span<double> values) const override;
  const Objective* surrogate() const override { return surrogate_; }

  /// The view at a point, evaluated unless it is remembered.
  ViewGain view(const Point& x) const;

  std::int64_t evaluations() const { return evaluations_; }

 private:
  struct Remembered {
    Point point;
    ViewGain view;
  };

  ViewGain evaluate(const Point& x) const;
  Transform pose(const Point& x) const;
  /// Counts, records and remembers an evaluation.
  void note(const Point& x, const ViewGain& view) const;

  const ViewEvaluator& evaluator_;
  const Objective* surrogate_;
  SearchTrace* trace_;
  mutable std::atomic<std::int64_t> evaluations_ = 0;
  mutable std::mutex mutex_;
  mutable std::optional<Remembered> start_;  ///< where the mast is
  mutable std::optional<Remembered> best_;
};

}  // namespace nbvopt
