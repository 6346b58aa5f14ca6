// The directions of a panorama's rays, in patches of 4 x 4 neighbours.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gain/panorama_sum.hpp"
#include "nbvopt/mast/mast.hpp"

namespace nbvopt::detail {

/// The rectangle of directions that views look at, in the frame of a base at rest: azimuth
/// counter-clockwise from its x axis, elevation up from its x, y plane. Radians.
struct DirectionRange {
  double azimuth_min = 0.0;
  double azimuth_max = 0.0;  ///< at most one turn more
  double elevation_min = 0.0;
  double elevation_max = 0.0;
};

/// What images from anywhere in these pans and tilts cover; half fields of view in radians.
DirectionRange directions_in_reach(const JointBox& box, double half_fov_h_rad,
                                   double half_fov_v_rad);

/// Rays at about a spacing: rows of equal elevation, as many in a row as its circle is long.
struct PanoramaDirections {
  /// The patches' middles lie at elevations and azimuths from which `sensor_offset_m`, the lever
  /// arm in body axes, follows as if the camera looked along them, tilted within the box.
  PanoramaDirections(const DirectionRange& range, double spacing_h_rad, double spacing_v_rad,
                     const JointBox& box, const Eigen::Vector3d& sensor_offset_m,
                     const Eigen::Matrix3d& R_map_base);

  std::size_t patch_count() const { return axis_x.size(); }

  // Of each ray, HitBlock::kSize a patch: unit direction in the base's axes, and solid angle.
  std::vector<double> x, y, z, solid_angle;

  // Of each patch, in the map's axes.
  std::vector<float> axis_x, axis_y, axis_z;     ///< the middle of its directions
  std::vector<float> radius;                     ///< how far, at most, a direction is from the axis
  std::vector<float> lever_x, lever_y, lever_z;  ///< from the mast's top to the optical centre
  /// How far behind their origin its rays would meet those of the patches beside, and above: a ray
  /// stands for w (d + apex_beside) (d + apex_above) across itself. 0 without a lever arm.
  std::vector<float> apex_beside, apex_above;
};

}  // namespace nbvopt::detail
