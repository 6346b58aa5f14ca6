// What a request's joints can reach, in joint space and in the map.
#pragma once

#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// Made once a plan.
struct Reach {
  MovingMast mast;
  JointBox joints;     ///< Algorithm 2's, whatever stands in the way
  Surroundings sight;  ///< of all that a view from inside the box can touch
};

/// The reach of a request whose joints are within their limits. Throws InputError when the base
/// drives more than 100 m or turns more than 100 rad meanwhile.
Reach reach_of(const PlanRequest& request, const Mast& mast, const SensorOptions& sensor,
               const Lattice& lattice);

/// The reachable box, its height cut at the first occupied voxel that the optical centre would meet
/// on its way up or down, the base moving on meanwhile; one that is inside an obstacle keeps its
/// height. The voxels in reach must be ready.
JointBox box_free_of_obstacles(const Reach& reach, const VoxelGrid& grid);

/// The state of the voxel that holds the optical centre once the joints have arrived; it must be
/// ready.
VoxelState state_at_camera(const VoxelGrid& grid, const MovingMast& mast,
                           const JointPosition& joints);

}  // namespace nbvopt
