// Everything that describes the camera and how its gain is counted: one struct, which the robot
// file and the `sensor` block of pose files fill.
#pragma once

#include <string>

#include "nbvopt/sensor/gain_choice.hpp"

namespace nbvopt {

enum class RayPattern {
  pixel_centres,  ///< through the pixel centres of the pinhole image (Section III-B.2)
  equal_angles,   ///< equally spaced in angle from edge to edge, as in the released code
};
enum class RangeAxis {
  euclidean,  ///< the range is measured from the optical centre (before Eq. 1)
  z_depth,    ///< the range is measured along the optical axis, as in the released code
};
enum class UncertaintyMode { distance, angle, both };  ///< Eq. 2, 7, 8: the paper's Fig. 2
enum class Counting {
  per_ray,    ///< the sum over rays (Section III-B.2)
  per_voxel,  ///< the sum over distinct voxels, each with its best ray (Eq. 13)
};
/// How the gains of Isler et al. take P_vis, the probability that a voxel is in sight.
enum class Visibility {
  paper,     ///< the product of 1 - p_occ over the voxels before it
  released,  ///< the product of p_occ, as the released code computes it
};
enum class NoReturn { clear, ignore };  ///< what a ray without a return does to the map

/// The default is the paper's Intel R200: 59 x 46 degrees, 0.5 to 4 m.
struct SensorOptions {
  double half_fov_horizontal_rad = 0.51487212933832716;  ///< 59 / 2 degrees
  double half_fov_vertical_rad = 0.40142572795869574;    ///< 46 / 2 degrees
  int horizontal_rays = 48;                              ///< of the planning image
  int vertical_rays = 36;
  int horizontal_pixels = 480;  ///< of the depth image that mapping uses
  int vertical_pixels = 360;
  double range_min_m = 0.5;       ///< D_min
  double range_max_m = 4.0;       ///< D_max
  double focal_distance_m = 1.0;  ///< D_F of Eq. 1
  /// The half angles that Eq. 5 and 6 divide by; 0 means the half field of view above.
  double uncertainty_half_fov_horizontal_rad = 0.0;
  double uncertainty_half_fov_vertical_rad = 0.0;
  UncertaintyMode uncertainty_mode = UncertaintyMode::both;
  double normal_weight = 0.0;  ///< of u_n in u; the mode's u has the rest
  RayPattern ray_pattern = RayPattern::pixel_centres;
  RangeAxis range_axis = RangeAxis::euclidean;
  Counting counting = Counting::per_ray;
  GainChoice gain = GainKind::positive;
  Visibility visibility = Visibility::paper;
  bool near_blocking = true;  ///< an occupied voxel that a ray leaves before D_min blocks it
  NoReturn no_return = NoReturn::clear;
  double occupied_uncertainty = 1.0;  ///< u of an occupied voxel whose map carries none

  bool operator==(const SensorOptions&) const = default;

  /// The Euclidean distance that rays end at, at most: along the optical axis, the corners of the
  /// image are farther away than range_max_m.
  double longest_range_m() const;

  /// Throws InputError that names the first bad field with its value.
  void validate() const;
};

std::string to_string(RayPattern value);
std::string to_string(RangeAxis value);
std::string to_string(UncertaintyMode value);
std::string to_string(Counting value);
std::string to_string(Visibility value);
std::string to_string(NoReturn value);

}  // namespace nbvopt
