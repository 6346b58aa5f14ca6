#include "nbvopt/planner/view_planner.hpp"

#include <mutex>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "planner/planner.hpp"
#include "planner/sample_landscape.hpp"

namespace nbvopt {
namespace {

constexpr const char* kExact = "exact";

Robot as_judged(Robot robot, const std::string& evaluator) {
  robot.sensor = evaluator_sensor(evaluator, robot.sensor);
  return robot;
}

}  // namespace

/// Keeps the planner of the newest version of the map.
class ViewPlanner::Impl {
 public:
  Impl(std::shared_ptr<SharedMap> map, const Robot& robot, const std::string& evaluator)
      : robot_(robot), mast_(robot.mast), evaluator_(evaluator), map_(std::move(map)) {
    newest();  // what cannot be used is refused now
  }
  Impl(std::shared_ptr<const VoxelGrid> grid, const Robot& robot, const HazardTable& hazards)
      : robot_(robot),
        mast_(robot.mast),
        evaluator_(kExact),
        grid_(std::move(grid)),
        hazards_(hazards) {
    newest();
  }

  /// Asks the planner of the newest version.
  template <class Question>
  auto ask(const Question& question) const {
    // The released code looks at the map itself, all others at a version that never changes.
    const auto held = evaluator_ == kExact ? std::shared_lock<std::shared_mutex>() : map_->hold();
    return question(*newest());
  }

  InsertResult insert(const Scan& scan, const Transform& T_map_sensor) {
    if (!map_) throw UsageError("a planner on one version of a grid has no map to insert into");
    if (robot_.sensor.gain.has(GainKind::expected)) {
      const std::scoped_lock lock(learning_mutex_);  // of two scans at once, each teaches
      HazardTable hazards = this->hazards();
      learn_hazards(*map_->grid(), scan, T_map_sensor, robot_.sensor, hazards);
      InsertResult result = map_->insert(scan, T_map_sensor, robot_.sensor);
      set_hazards(hazards);
      return result;
    }
    return map_->insert(scan, T_map_sensor, robot_.sensor);
  }

  HazardTable hazards() const {
    const std::scoped_lock lock(mutex_);
    return hazards_;
  }
  void set_hazards(const HazardTable& hazards) {
    const std::scoped_lock lock(mutex_);
    hazards_ = hazards;
    newest_.reset();
  }

  const Robot& robot() const { return robot_; }
  const Mast& mast() const { return mast_; }
  const std::string& evaluator() const { return evaluator_; }

 private:
  std::shared_ptr<const Planner> newest() const {
    const std::shared_ptr<const VoxelGrid> grid = map_ ? map_->grid() : grid_;
    const std::scoped_lock lock(mutex_);
    if (newest_ && newest_->grid() == grid) return newest_;
    std::shared_ptr<const ViewEvaluator> evaluator =
        map_ ? make_evaluator(evaluator_, map_->map(), grid, robot_.sensor, hazards_)
             : make_exact_evaluator(grid, DepthCamera(robot_.sensor), hazards_);
    newest_ = std::make_shared<const Planner>(robot_, grid, std::move(evaluator), hazards_);
    return newest_;
  }

  Robot robot_;
  Mast mast_;
  std::string evaluator_;
  std::shared_ptr<SharedMap> map_;  ///< shared with other planners; null: the grid is all there is
  std::shared_ptr<const VoxelGrid> grid_;  ///< where there is no map
  std::mutex learning_mutex_;              ///< from reading the hazards to writing them
  mutable std::mutex mutex_;               ///< of what follows
  HazardTable hazards_;
  mutable std::shared_ptr<const Planner> newest_;  ///< shared with the calls that use it
};

ViewPlanner::ViewPlanner(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

ViewPlanner::ViewPlanner(UncertaintyMap map, const Robot& robot, const std::string& evaluator)
    : ViewPlanner(std::make_shared<SharedMap>(std::move(map)), robot, evaluator) {}

ViewPlanner::ViewPlanner(std::shared_ptr<SharedMap> map, const Robot& robot,
                         const std::string& evaluator)
    : ViewPlanner(std::make_unique<Impl>(std::move(map), as_judged(robot, evaluator), evaluator)) {}

ViewPlanner::ViewPlanner(std::shared_ptr<const VoxelGrid> grid, const Robot& robot,
                         const HazardTable& hazards)
    : ViewPlanner(std::make_unique<Impl>(std::move(grid), robot, hazards)) {}

ViewPlanner ViewPlanner::with_given_sensor(UncertaintyMap map, const Robot& robot,
                                           const std::string& evaluator) {
  return ViewPlanner(
      std::make_unique<Impl>(std::make_shared<SharedMap>(std::move(map)), robot, evaluator));
}

ViewPlanner::ViewPlanner(ViewPlanner&&) noexcept = default;
ViewPlanner& ViewPlanner::operator=(ViewPlanner&&) noexcept = default;
ViewPlanner::~ViewPlanner() = default;

PlanResult ViewPlanner::plan(const PlanRequest& request) const { return plan(request, Search{}); }

PlanResult ViewPlanner::plan(const PlanRequest& request, const Search& search) const {
  return plan(request, *make_solver(search));
}

PlanResult ViewPlanner::plan(const PlanRequest& request, const Solver& solver) const {
  return impl_->ask([&](const Planner& planner) { return planner.plan(request, solver); });
}

CertifiedView ViewPlanner::certify(const PlanRequest& request, const JointPosition& joints) const {
  return impl_->ask([&](const Planner& planner) { return planner.certify(request, joints); });
}

ViewGain ViewPlanner::evaluate(const Transform& T_map_sensor) const {
  return impl_->ask(
      [&](const Planner& planner) { return planner.evaluator().evaluate(T_map_sensor); });
}

std::vector<ViewGain> ViewPlanner::evaluate(std::span<const Transform> poses_T_map_sensor,
                                            int threads, const StopRule& stop) const {
  return impl_->ask([&](const Planner& planner) {
    return evaluate_views(planner.evaluator(), poses_T_map_sensor, threads, stop);
  });
}

Landscape ViewPlanner::landscape(const PlanResult& result, int threads,
                                 const StopRule& stop) const {
  return impl_->ask([&](const Planner& planner) {
    return sample_landscape(planner.evaluator(), planner.mast(), result, threads, stop);
  });
}

JointBox ViewPlanner::reachable_box(const PlanRequest& request) const {
  return impl_->ask([&](const Planner& planner) { return planner.reachable_box(request); });
}

void ViewPlanner::make_ready(const PlanRequest& request) const {
  impl_->ask([&](const Planner& planner) { planner.make_ready(request); });
}

InsertResult ViewPlanner::insert(const Scan& scan, const Transform& T_map_sensor) {
  return impl_->insert(scan, T_map_sensor);
}

HazardTable ViewPlanner::hazards() const { return impl_->hazards(); }
void ViewPlanner::set_hazards(const HazardTable& hazards) { impl_->set_hazards(hazards); }
const Robot& ViewPlanner::robot() const { return impl_->robot(); }
const Mast& ViewPlanner::mast() const { return impl_->mast(); }
const std::string& ViewPlanner::evaluator() const { return impl_->evaluator(); }

std::shared_ptr<const VoxelGrid> ViewPlanner::grid() const {
  return impl_->ask([](const Planner& planner) { return planner.grid(); });
}

}  // namespace nbvopt
