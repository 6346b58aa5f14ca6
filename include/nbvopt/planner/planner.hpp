// The planner: where should the camera look next?
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

class ViewObjective;

/// One question. Born with NaN where there is no sensible default.
struct PlanRequest {
  Transform T_map_base = Transform::Identity();  ///< where the base is now
  BaseTwist base_twist;        ///< its velocity, which it keeps until the joints have arrived
  JointPosition joints;        ///< where the joints are now
  double motion_time_s = 0.0;  ///< the joints' travel time, t of Algorithm 2; 0: no limit
  double min_gain = 1.0;       ///< below it the planner says that there is nothing to gain
  StopRule stop;
  std::uint64_t seed = 1;
  bool record_trace = false;                 ///< whether the answer lists every evaluation
  std::optional<PanoramaOptions> surrogate;  ///< none: planning_panorama()
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

enum class EvaluationKind {
  exact,      ///< by the evaluator
  surrogate,  ///< by what strategies search on
};
std::string to_string(EvaluationKind kind);

/// One evaluation of a search.
struct TracePoint {
  EvaluationKind kind = EvaluationKind::exact;
  JointPosition joints;
  double gain = std::numeric_limits<double>::quiet_NaN();
  double best_gain = std::numeric_limits<double>::quiet_NaN();  ///< exact, this one included
  double time_ms = std::numeric_limits<double>::quiet_NaN();    ///< since the planner was called
};

/// One answer. Its gain is exact (or the baseline's, where that evaluator was asked for), its
/// joints lie in the reachable box and are never worse than staying.
struct PlanResult {
  PlanStatus status = PlanStatus::not_run;
  std::string message = "the planner was not called";
  JointPosition joints;
  Transform T_map_sensor = Transform::Identity();  ///< once the joints have arrived
  Transform T_map_base = Transform::Identity();    ///< once the joints have arrived
  ViewGain view;                                   ///< at `joints`
  ViewGain current;                                ///< of staying
  double move_time_s = std::numeric_limits<double>::quiet_NaN();
  JointBox box;                            ///< the reachable box, obstacles included
  std::vector<std::string> active_bounds;  ///< such as "tilt_min": faces that the answer lies on
  std::int64_t evaluations = 0;            ///< of the evaluator, staying included
  std::int64_t surrogate_evaluations = 0;  ///< of the surrogate
  double search_time_ms = std::numeric_limits<double>::quiet_NaN();
  std::string solver;
  std::uint64_t seed = 0;
  std::uint64_t map_version = 0;
  std::vector<std::string> warnings;
  std::vector<TracePoint> trace;  ///< every evaluation in order, where the request asks for it
};

/// Plans on one published grid. Const and safe to share between threads.
class Planner {
 public:
  /// The evaluator judges every candidate on the same map as the grid, which is shared with the
  /// caller and tells what the mast must not touch.
  Planner(const Robot& robot, std::shared_ptr<const VoxelGrid> grid,
          std::shared_ptr<const ViewEvaluator> evaluator);

  /// Answers with the given solver. Throws InputError when the request is not usable: a pose, twist
  /// or joint that is not finite, a joint beyond its limits, a negative motion time, a base that
  /// drives or turns too far.
  PlanResult plan(const PlanRequest& asked, const Solver& solver) const;

  /// The box of Algorithm 2 around the request's joints, which are within their limits, its height
  /// cut at the first occupied voxel that the optical centre would meet on its way up or down, the
  /// base moving on meanwhile. The voxels in reach must be ready.
  JointBox search_box(const PlanRequest& request) const;

  /// Every voxel that a view from inside the reachable box can touch, the request's joints being
  /// within their limits. Throws InputError when the base drives more than 100 m or turns more than
  /// 100 rad meanwhile.
  KeyBox reachable_voxels(const PlanRequest& request) const;

 private:
  /// Fills the answer from what the solver found.
  void choose(const PlanRequest& request, const MovingMast& mast, const ViewObjective& objective,
              const SolveResult& solved, PlanResult& result) const;
  /// The state of the voxel that holds the optical centre once the joints have arrived.
  VoxelState state_at_camera(const MovingMast& mast, const JointPosition& joints) const;
  void warn_of_map(const KeyBox& reachable, VoxelState at_camera,
                   std::vector<std::string>& warnings) const;

  Mast mast_;
  SensorOptions sensor_;
  std::shared_ptr<const VoxelGrid> grid_;
  std::shared_ptr<const ViewEvaluator> evaluator_;
};

/// The panorama that searches see: half as dense as the sensor's rays, and few layers, since what
/// finer ones find is not better once it was polished on the exact gain. Per voxel it has the
/// sensor's own density, or rays on a voxel could not be counted.
PanoramaOptions planning_panorama(Counting counting);

/// The mast of a request's robot on its moving base: what turns q into a sensor pose.
MovingMast moving_mast(const PlanRequest& request, const Mast& mast);

/// The optical frame of a request's robot once its joints have arrived at these.
Transform T_map_sensor(const PlanRequest& request, const Mast& mast, const JointPosition& joints);

}  // namespace nbvopt
