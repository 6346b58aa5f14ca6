// A question to the planner, and its answer.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/mast/moving_mast.hpp"

namespace nbvopt {

/// Where the base will be at a time.
struct TimedPose {
  double time_s = 0.0;  ///< from now
  Transform T_map_base = Transform::Identity();
};

/// Asks for a bound on what any view in reach gains.
struct CertifyOptions {
  double gap = 0.01;              ///< it is enough once Certificate::gap() is no larger
  double time_limit_ms = 10'000;  ///< after the search; the request's stop rule holds as well
  /// Stops after about so many, wherever it runs; Certificate::cones tells how many they were.
  std::int64_t max_cones = std::numeric_limits<std::int64_t>::max();
  bool operator==(const CertifyOptions&) const = default;
};

/// A bound on what any view in reach gains, and what it took. It holds whenever it was stopped.
struct Certificate {
  double upper_bound = std::numeric_limits<double>::quiet_NaN();
  /// Of the best view known: the answer's, unless that is to stay for want of gain.
  double gain = std::numeric_limits<double>::quiet_NaN();
  std::int64_t cones = 0;  ///< bundles of rays that were followed through the map
  int improvements = 0;    ///< how often it found a better view than those before
  double time_ms = std::numeric_limits<double>::quiet_NaN();

  /// What a better view could add at most, as a share of the bound, in [0, 1].
  double gap() const { return upper_bound > 0.0 ? 1.0 - gain / upper_bound : 0.0; }
  bool operator==(const Certificate&) const = default;
};

/// A view, and a bound on what any other gains.
struct CertifiedView {
  JointPosition joints;  ///< the best known
  Certificate certificate;
};

/// One question. Born with NaN where there is no sensible default.
struct PlanRequest {
  Transform T_map_base = Transform::Identity();  ///< where the base is now
  BaseTwist base_twist;  ///< its velocity, which it keeps until the joints have arrived
  /// Where the base will be, if its driver knows: times rise from 0 or later, the base comes from
  /// T_map_base and stays where the path ends. The view is then taken when the motion time, which
  /// must not be 0, is over, from where the path leads by then. Not together with a twist.
  std::vector<TimedPose> base_path;
  JointPosition joints;        ///< where the joints are now
  double motion_time_s = 0.0;  ///< the joints' travel time, t of Algorithm 2; 0: no limit
  /// Below it the planner says that there is nothing to gain. None: 1 where the robot's gain is
  /// positive or expected, 0 for any other, each of which has a unit of its own.
  std::optional<double> min_gain;
  StopRule stop;
  std::uint64_t seed = 1;
  bool record_trace = false;                 ///< whether the answer lists every evaluation
  std::optional<PanoramaOptions> surrogate;  ///< none: planning_panorama()
  std::optional<CertifyOptions> certify;     ///< none: no bound is computed
};

enum class PlanStatus {
  not_run,
  optimal_within_tolerance,
  grid_complete,
  evaluation_limit,
  time_limit,
  no_gain_in_reach,
  cancelled,
  certified,  ///< the gap that was asked for is met
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
  double time_ms = std::numeric_limits<double>::quiet_NaN();    ///< since the search began
};

/// One answer. Its gain is exact (or the baseline's, where that evaluator was asked for), its
/// joints lie in the reachable box and are never worse than staying.
struct PlanResult {
  PlanStatus status = PlanStatus::not_run;
  std::string message = "the planner was not called";
  PlanRequest request;  ///< the question, its joints moved into their limits
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
  double search_time_ms = std::numeric_limits<double>::quiet_NaN();  ///< without grid_ms
  /// Of reading the voxels in reach from the map, next to nothing where they were read before.
  double grid_ms = std::numeric_limits<double>::quiet_NaN();
  std::string solver;
  std::uint64_t seed = 0;
  std::uint64_t map_version = 0;
  /// What an expected gain took for likely of the unknown, and how much it was learnt from; none
  /// where the gain is not.
  std::optional<HazardTable> hazards;
  std::optional<Certificate> certificate;  ///< where the request asks for it
  std::vector<std::string> warnings;
  std::vector<TracePoint> trace;  ///< every evaluation in order, where the request asks for it
};

/// The panorama that searches see: half as dense as the sensor's rays, since what a finer one finds
/// is not better once it was polished on the exact gain. Per voxel it has the sensor's own density,
/// or rays on a voxel could not be counted.
PanoramaOptions planning_panorama(Counting counting);

/// Where a request's path has the base when the motion time is over, between two poses on the
/// straight way; T_map_base without a path.
Transform T_map_base_on_path(const PlanRequest& request);

/// The mast of a request's robot on its moving base: what turns q into a sensor pose. On a path it
/// rests where the view will be taken.
MovingMast moving_mast(const PlanRequest& request, const Mast& mast);

/// The optical frame of a request's robot once its joints have arrived at these.
Transform T_map_sensor(const PlanRequest& request, const Mast& mast, const JointPosition& joints);

}  // namespace nbvopt
