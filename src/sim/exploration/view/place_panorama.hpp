// What a camera is worth at a place of the base: the information that looking all around it would
// bring, told by where in space it would come from.
//
// Rays are cast in all directions that the mast can turn the camera to, far fewer than the sensor
// has: a coarse panorama. A hit stands for so much surface, and so for so many voxels, each of
// which would bring u_old - u_new (Eq. 12), u_new at its distance in the mean over the image. So
// the unit is that of Eq. 11, information, whatever the distance, and what is seen from several
// places can be counted once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "gain/panorama_directions.hpp"
#include "gain/panorama_sum.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt {

/// What is to be had in a cube of space.
struct CubeGain {
  std::uint64_t cube;  ///< names the cube
  double information;
};

/// Each cube once.
using PlaceGain = std::vector<CubeGain>;

/// Casts panoramas. Const and safe to share between threads.
class PlacePanorama {
 public:
  /// Of a robot whose map has voxels of that size. Throws InputError when the sensor or the mast
  /// cannot be used.
  PlacePanorama(const Robot& robot, double resolution_m);

  /// With the base at a place (z is the floor's) and the mast half way up. The base may turn there,
  /// so that a pan axis beside its origin is taken to be on it.
  PlaceGain look_around(const VoxelGrid& grid, const HazardTable& hazards,
                        const Eigen::Vector3d& base_map_m) const;

 private:
  Robot robot_;
  detail::PanoramaModel model_;
  double resolution_m_;
  JointBox box_;  ///< of the joints
  detail::PanoramaDirections directions_;
};

/// How many images side by side see all around once.
int views_around(const SensorOptions& sensor);

}  // namespace nbvopt
