#include "planner/view_objective.hpp"

namespace nbvopt {

ViewObjective::ViewObjective(const MovingMast& mast, const SensorOptions& sensor,
                             const JointBox& box, const ViewEvaluator& evaluator,
                             const Objective* surrogate, SearchTrace* trace)
    : JointObjective(mast, sensor, box),
      evaluator_(evaluator),
      surrogate_(surrogate),
      trace_(trace) {}

double ViewObjective::value(const Point& x) const { return evaluate(x).gain; }

void ViewObjective::values(std::span<const Point> points, std::span<double> values) const {
  std::vector<Transform> poses;
  poses.reserve(points.size());
  for (const Point& x : points) poses.push_back(pose(x));
  const std::vector<ViewGain> views = evaluate_views(evaluator_, poses);
  for (std::size_t i = 0; i < points.size(); ++i) {
    note(points[i], views[i]);
    values[i] = views[i].gain;
  }
}

ViewGain ViewObjective::view(const Point& x) const {
  {
    const std::scoped_lock lock(mutex_);
    for (const auto* remembered : {&start_, &best_}) {
      if (*remembered && (*remembered)->point == x) return (*remembered)->view;
    }
  }
  return evaluate(x);
}

ViewGain ViewObjective::evaluate(const Point& x) const {
  const ViewGain view = evaluator_.evaluate(pose(x));
  note(x, view);
  return view;
}

Transform ViewObjective::pose(const Point& x) const {
  return mast().T_map_sensor(JointPosition::from(x));
}

void ViewObjective::note(const Point& x, const ViewGain& view) const {
  ++evaluations_;
  if (trace_ != nullptr) trace_->record(EvaluationKind::exact, JointPosition::from(x), view.gain);
  const std::scoped_lock lock(mutex_);
  if (x == mast().joints().vector()) start_ = {x, view};
  const bool is_better = !best_ || view.gain > best_->view.gain ||
                         (view.gain == best_->view.gain && tie_cost(x) < tie_cost(best_->point));
  if (is_better) best_ = {x, view};
}

}  // namespace nbvopt
