#include "planner/view_objective.hpp"

namespace nbvopt {

ViewObjective::ViewObjective(const PlanRequest& request, const Mast& mast,
                             const JointPosition& joints, const JointBox& box,
                             const ViewEvaluator& evaluator)
    : request_(request),
      mast_(mast),
      joints_(joints),
      box_{box.min, box.max},
      evaluator_(evaluator) {}

double ViewObjective::value(const Point& x) const {
  const ViewGain view = evaluator_.evaluate(pose(x));
  ++evaluations_;
  remember(x, view);
  return view.gain;
}

void ViewObjective::values(std::span<const Point> points, std::span<double> values) const {
  std::vector<Transform> poses;
  poses.reserve(points.size());
  for (const Point& x : points) poses.push_back(pose(x));
  const std::vector<ViewGain> views = evaluate_views(evaluator_, poses);
  evaluations_ += static_cast<std::int64_t>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    remember(points[i], views[i]);
    values[i] = views[i].gain;
  }
}

double ViewObjective::tie_cost(const Point& x) const {
  return mast_.move_time_s(joints_, JointPosition::from(x));
}

ViewGain ViewObjective::view(const Point& x) const {
  {
    const std::scoped_lock lock(mutex_);
    for (const auto* remembered : {&start_, &best_}) {
      if (*remembered && (*remembered)->point == x) return (*remembered)->view;
    }
  }
  ++evaluations_;
  return evaluator_.evaluate(pose(x));
}

Transform ViewObjective::pose(const Point& x) const {
  return T_map_sensor(request_, mast_, JointPosition::from(x));
}

void ViewObjective::remember(const Point& x, const ViewGain& view) const {
  const std::scoped_lock lock(mutex_);
  if (x == joints_.vector()) start_ = {x, view};
  const bool is_better = !best_ || view.gain > best_->view.gain ||
                         (view.gain == best_->view.gain && tie_cost(x) < tie_cost(best_->point));
  if (is_better) best_ = {x, view};
}

}  // namespace nbvopt
