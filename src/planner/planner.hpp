// Planning on one version of a map: what ViewPlanner does between two scans.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/solver/solver.hpp"
#include "planner/reach.hpp"

namespace nbvopt {

class ViewObjective;

/// Const and safe to share between threads. A request that is not usable throws InputError: a pose,
/// twist or joint that is not finite, a joint beyond its limits, a negative motion time, a base
/// that drives or turns too far.
class Planner {
 public:
  /// The evaluator judges every candidate on the same map as the grid, which is shared with the
  /// caller and tells what the mast must not touch. Surrogates of an expected gain have the
  /// hazards.
  Planner(const Robot& robot, std::shared_ptr<const VoxelGrid> grid,
          std::shared_ptr<const ViewEvaluator> evaluator,
          const HazardTable& hazards = HazardTable());

  PlanResult plan(const PlanRequest& asked, const Solver& solver) const;

  /// As ViewPlanner::certify().
  CertifiedView certify(const PlanRequest& asked, const JointPosition& joints) const;

  /// PlanResult::box.
  JointBox reachable_box(const PlanRequest& asked) const;

  /// Reads the voxels that a plan needs ahead of it.
  void make_ready(const PlanRequest& asked) const;

  const Mast& mast() const { return mast_; }
  const std::shared_ptr<const VoxelGrid>& grid() const { return grid_; }
  const ViewEvaluator& evaluator() const { return *evaluator_; }

 private:
  /// The request with its joints within their limits.
  PlanRequest usable(const PlanRequest& asked, std::vector<std::string>& warnings) const;
  /// The request's reach, its voxels ready.
  Reach ready_reach(const PlanRequest& request) const;
  /// With less to be had the answer is to stay.
  double least_gain(const PlanRequest& request) const;
  /// Fills the answer from what the solver found.
  void choose(const MovingMast& mast, const ViewObjective& objective, const SolveResult& solved,
              PlanResult& result) const;
  void warn_of_map(const Surroundings& sight, VoxelState at_camera,
                   std::vector<std::string>& warnings) const;

  Mast mast_;
  SensorOptions sensor_;
  std::shared_ptr<const VoxelGrid> grid_;
  std::shared_ptr<const ViewEvaluator> evaluator_;
  HazardTable hazards_;
};

}  // namespace nbvopt
