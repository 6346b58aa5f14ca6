// Evaluators of views: the truth ("exact") and the baseline ("paper-code").
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/core/transform.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {

/// The gain of views. Const and safe to share between threads.
class ViewEvaluator {
 public:
  virtual ~ViewEvaluator() = default;
  virtual std::string name() const = 0;

  /// The gain of the view from T_map_sensor. Throws InputError when the pose is not finite or
  /// lies off the lattice.
  virtual ViewGain evaluate(const Transform& T_map_sensor) const = 0;
};

/// Every voxel that a ray pierces is visited, in order, over the grid. The camera is copied; the
/// grid is shared with the caller.
std::unique_ptr<ViewEvaluator> make_exact_evaluator(std::shared_ptr<const VoxelGrid> grid,
                                                    const DepthCamera& camera,
                                                    const std::string& gain_model = "paper",
                                                    SimdLevel level = SimdLevel::best);

/// The evaluator of the gain that the camera's options name.
std::unique_ptr<ViewEvaluator> make_exact_evaluator(std::shared_ptr<const VoxelGrid> grid,
                                                    const DepthCamera& camera,
                                                    const HazardTable& hazards);

/// The expected gain: a ray goes on through unknown space, in which it meets a surface with the
/// hazards of the table. A piece of it where it does so with probability P gives P (1 - u_new),
/// u_new at the mean depth of a hit there; what is left of the ray gives max(0, u_old - u_new) at
/// the first occupied voxel. Infinite hazards give Eq. 12. Unknown space before range_min
/// attenuates and brings nothing. Per voxel, each voxel counts with the ray that is expected to
/// bring most there. In the ViewGain, a ray that comes through an unknown voxel in range is an
/// unknown one.
std::unique_ptr<ViewEvaluator> make_expected_evaluator(std::shared_ptr<const VoxelGrid> grid,
                                                       const DepthCamera& camera,
                                                       const HazardTable& hazards,
                                                       SimdLevel level = SimdLevel::best);

/// The released code of the paper as it runs: samples along the ray at range_min + i * resolution,
/// one octree search each. Always per ray and without near blocking. The map must outlive the
/// evaluator and must not change.
std::unique_ptr<ViewEvaluator> make_paper_code_evaluator(const UncertaintyMap& map,
                                                         const SensorOptions& sensor);

/// The camera that the released code describes, on this sensor: rays equally spaced in angle,
/// range along z, normalisation by 0.52 and 0.41 rad, no near blocking, per ray.
SensorOptions paper_code_sensor(SensorOptions sensor);

/// Evaluates all views on at most `threads` threads (0: all cores), in any order; gains[i] is
/// that of poses[i]. Stops early, leaving the rest "not evaluated", when `stop` says so.
/// The answer does not depend on the number of threads.
std::vector<ViewGain> evaluate_views(const ViewEvaluator& evaluator,
                                     std::span<const Transform> poses_T_map_sensor, int threads = 0,
                                     const StopRule& stop = {});

}  // namespace nbvopt
