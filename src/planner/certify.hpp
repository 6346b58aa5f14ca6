// A bound on the gain of all views in reach by branch and bound, and better views on the way.
#pragma once

#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/planner/plan.hpp"
#include "planner/view_objective.hpp"

namespace nbvopt {

/// Bounds the gain of all views of the box. `joints` is the best view known; the objective is the
/// gain of the evaluator "exact", positive or expected. Stops once the gap is met, once its time,
/// the deadline or the token of `stop` ends it, or where no finer boxes are told apart.
CertifiedView certify(const VoxelGrid& grid, const SensorOptions& sensor, const MovingMast& mast,
                      const JointBox& box, const ViewObjective& objective,
                      const JointPosition& joints, const CertifyOptions& options,
                      const StopRule& stop);

}  // namespace nbvopt
