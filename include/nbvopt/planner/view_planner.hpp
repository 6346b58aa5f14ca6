// The front door: where should the camera look next?
//
//   const ViewPlanner planner(read_map("office.ot"), Robot{});
//   PlanRequest request;
//   request.T_map_base = base_pose(-1.5, 2.0, 0.0, 0.3);
//   request.joints = {.pan_rad = 0.0, .tilt_rad = -0.2, .height_m = 0.4};
//   request.motion_time_s = 0.5;
//   const PlanResult look = planner.plan(request);
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/core/transform.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/map/shared_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/landscape.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/solver/search.hpp"
#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// Plans views of a map for one robot, judged by one evaluator. Const calls are safe to share
/// between threads; a plan sees every scan that was inserted before it began.
///
/// Requests may have joints up to 0.01 rad or 5 mm beyond their limits, which are moved into them,
/// with a warning in the answer. Throws InputError for a request that is not usable: a pose, twist
/// or joint that is not finite, a joint farther beyond its limits, a negative motion time, a base
/// that drives more than 100 m or turns more than 100 rad while the joints move.
class ViewPlanner {
 public:
  /// On a map of its own. `evaluator` is one of evaluator_names(); "paper-code" describes its own
  /// camera on the robot's sensor. Throws UsageError when the name is not known, and InputError
  /// when an option of the robot cannot be used.
  ViewPlanner(UncertaintyMap map, const Robot& robot, const std::string& evaluator = "exact");

  /// On a map that others look at too: planners for other robots or by other evaluators, say.
  ViewPlanner(std::shared_ptr<SharedMap> map, const Robot& robot,
              const std::string& evaluator = "exact");

  /// On one version of a map that somebody else keeps, judged by "exact".
  ViewPlanner(std::shared_ptr<const VoxelGrid> grid, const Robot& robot,
              const HazardTable& hazards = HazardTable());

  /// As the first, but the robot's sensor is taken as it is, whatever camera the evaluator
  /// describes: for fields that were set on top of evaluator_sensor(). Throws UsageError also when
  /// the evaluator cannot count as the sensor says.
  static ViewPlanner with_given_sensor(UncertaintyMap map, const Robot& robot,
                                       const std::string& evaluator);

  ViewPlanner(ViewPlanner&&) noexcept;
  ViewPlanner& operator=(ViewPlanner&&) noexcept;
  ~ViewPlanner();

  /// Answers by the search "auto".
  PlanResult plan(const PlanRequest& request) const;

  /// Answers by another search. Throws UsageError as make_solver() does.
  PlanResult plan(const PlanRequest& request, const Search& search) const;

  /// Answers with a solver of your own.
  PlanResult plan(const PlanRequest& request, const Solver& solver) const;

  /// Bounds the gain of all views in the request's reach, as its `certify` says or by default, and
  /// improves on the view at `joints`. Throws UsageError where the planner's evaluator is not
  /// "exact" or its gain neither positive nor expected.
  CertifiedView certify(const PlanRequest& request, const JointPosition& joints) const;

  /// The gain of one view; joint limits do not bind. Throws InputError when the pose is not finite
  /// or lies off the map's lattice.
  ViewGain evaluate(const Transform& T_map_sensor) const;

  /// The gains of N views in their order; `threads` and `stop` as in evaluate_views().
  std::vector<ViewGain> evaluate(std::span<const Transform> poses_T_map_sensor, int threads = 0,
                                 const StopRule& stop = {}) const;

  /// The gain around an answer of this planner, over the reachable pans and tilts at its height: a
  /// view every 0.05 rad, or as dense as 20,000 views allow. `threads` and `stop` as in
  /// evaluate_views(): views that were left out gain NaN.
  Landscape landscape(const PlanResult& result, int threads = 0, const StopRule& stop = {}) const;

  /// The reachable joint positions of a request, obstacles included, as in PlanResult::box.
  JointBox reachable_box(const PlanRequest& request) const;

  /// Reads the voxels in reach of a request ahead of its plan, which then spends no grid_ms.
  void make_ready(const PlanRequest& request) const;

  /// Inserts a scan taken from T_map_sensor with the robot's sensor; the next plan sees it.
  /// Plans that run in other threads end on the version that they began on; "paper-code" has none,
  /// and is waited for. Where the sensor's gain is expected, its hazards are learnt from the scan.
  /// Throws as insert_scan() does, the map then untouched, and UsageError on a
  /// planner that has no map but one version of its grid.
  InsertResult insert(const Scan& scan, const Transform& T_map_sensor);

  /// What an expected gain takes for likely of the unknown: what its scans have taught this
  /// planner, or what it was given.
  HazardTable hazards() const;
  void set_hazards(const HazardTable& hazards);

  /// The robot, its sensor as the evaluator describes it.
  const Robot& robot() const;
  const Mast& mast() const;
  const std::string& evaluator() const;

  std::uint64_t map_version() const { return grid()->version(); }

  /// The newest version of the voxels that planning works on.
  std::shared_ptr<const VoxelGrid> grid() const;

 private:
  class Impl;
  explicit ViewPlanner(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace nbvopt
