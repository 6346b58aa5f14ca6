// The planner: where should the camera look next?
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

class ViewObjective;

/// One question. Born with NaN where there is no sensible default.
struct PlanRequest {
  Transform T_map_base = Transform::Identity();
  BaseTwist base_twist;
  JointPosition joints;        ///< where the joints are now
  double motion_time_s = 0.0;  ///< the joints' travel time, t of Algorithm 2; 0: no limit
  double min_gain = 1.0;       ///< below it the planner says that there is nothing to gain
  StopRule stop;
  std::uint64_t seed = 1;
};

enum class PlanStatus {
  not_run,
  optimal_within_tolerance,
  grid_complete,
  evaluation_limit,
  time_limit,
  no_gain_in_reach,
  cancelled,
};
std::string to_string(PlanStatus status);

/// One answer. Its gain is exact (or the baseline's, where that evaluator was asked for), its
/// joints lie in the reachable box and are never worse than staying.
struct PlanResult {
  PlanStatus status = PlanStatus::not_run;
  std::string message = "the planner was not called";
  JointPosition joints;
  Transform T_map_sensor = Transform::Identity();
  ViewGain view;     ///< at `joints`
  ViewGain current;  ///< of staying
  double move_time_s = std::numeric_limits<double>::quiet_NaN();
  JointBox box;                            ///< the reachable box, obstacles included
  std::vector<std::string> active_bounds;  ///< such as "tilt_min": faces that the answer lies on
  std::int64_t evaluations = 0;            ///< of the evaluator, staying included
  double search_time_ms = std::numeric_limits<double>::quiet_NaN();
  std::string solver;
  std::uint64_t seed = 0;
  std::uint64_t map_version = 0;
  std::vector<std::string> warnings;
};

/// Plans on one published grid. Const and safe to share between threads.
class Planner {
 public:
  /// The evaluator judges every candidate on the same map as the grid, which is shared with the
  /// caller and tells what the mast must not touch.
  Planner(const Robot& robot, std::shared_ptr<const VoxelGrid> grid,
          std::shared_ptr<const ViewEvaluator> evaluator);

  /// Answers with the given solver. Throws InputError when the request is not usable: a pose or
  /// joint that is not finite, a joint beyond its limits, a negative motion time.
  PlanResult plan(const PlanRequest& request, const Solver& solver) const;

  /// The box of Algorithm 2 around joints within their limits, its height cut at the first
  /// occupied voxel above and below the optical centre. The voxels in reach must be ready.
  JointBox search_box(const PlanRequest& request, const JointPosition& joints) const;

  /// Every voxel that a view from inside the reachable box can touch.
  KeyBox reachable_voxels(const PlanRequest& request, const JointPosition& joints) const;

 private:
  /// Fills the answer from what the solver found.
  void choose(const PlanRequest& request, const JointPosition& joints,
              const ViewObjective& objective, const SolveResult& solved, PlanResult& result) const;
  /// The state of the voxel that holds the optical centre.
  VoxelState state_at_camera(const PlanRequest& request, const JointPosition& joints) const;
  void warn_of_map(const KeyBox& reachable, VoxelState at_camera,
                   std::vector<std::string>& warnings) const;

  Mast mast_;
  SensorOptions sensor_;
  std::shared_ptr<const VoxelGrid> grid_;
  std::shared_ptr<const ViewEvaluator> evaluator_;
};

/// The optical frame of a request's robot at these joints: the only function that turns a request
/// and q into a sensor pose.
Transform T_map_sensor(const PlanRequest& request, const Mast& mast, const JointPosition& joints);

}  // namespace nbvopt
