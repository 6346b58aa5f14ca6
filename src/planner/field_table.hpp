// The one list of the robot's fields: key, field, and the comment that the robot file shows.
#pragma once

#include <concepts>
#include <type_traits>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

template <class T, class Options>
concept ConstOrNot = std::same_as<std::remove_const_t<T>, Options>;

/// The name of the block in files and messages.
inline const char* block_name(const SensorOptions&) { return "sensor"; }
inline const char* block_name(const MastOptions&) { return "mast"; }

/// Calls visit(key, field, comment) for every field of the sensor, in the file's order.
template <ConstOrNot<SensorOptions> Sensor, class Visit>
void for_each_field(Sensor& s, Visit&& visit) {
  visit("half_fov_horizontal_rad", s.half_fov_horizontal_rad,
        "rad; half the horizontal field of view");
  visit("half_fov_vertical_rad", s.half_fov_vertical_rad, "rad; half the vertical field of view");
  visit("horizontal_rays", s.horizontal_rays, "rays; columns of the planning image");
  visit("vertical_rays", s.vertical_rays, "rays; rows of the planning image");
  visit("horizontal_pixels", s.horizontal_pixels, "pixels; width of the depth image for mapping");
  visit("vertical_pixels", s.vertical_pixels, "pixels; height of the depth image for mapping");
  visit("range_min_m", s.range_min_m, "m; D_min");
  visit("range_max_m", s.range_max_m, "m; D_max");
  visit("focal_distance_m", s.focal_distance_m, "m; D_F of Eq. 1, where the camera sees best");
  visit("uncertainty_half_fov_horizontal_rad", s.uncertainty_half_fov_horizontal_rad,
        "rad; what Eq. 5 divides by, 0: the half field of view");
  visit("uncertainty_half_fov_vertical_rad", s.uncertainty_half_fov_vertical_rad,
        "rad; what Eq. 6 divides by, 0: the half field of view");
  visit("uncertainty_mode", s.uncertainty_mode, "distance (Eq. 2), angle (Eq. 7) or both (Eq. 8)");
  visit("ray_pattern", s.ray_pattern, "pixel_centres or equal_angles");
  visit("range_axis", s.range_axis, "euclidean or z_depth");
  visit("counting", s.counting, "per_ray or per_voxel (Eq. 13)");
  visit("near_blocking", s.near_blocking,
        "true: an occupied voxel nearer than range_min_m blocks the ray");
  visit("no_return", s.no_return, "clear or ignore: what a ray without a return does to the map");
  visit("occupied_uncertainty", s.occupied_uncertainty,
        "0 to 1; u of an occupied voxel whose map carries none");
}

/// The same for the mast.
template <ConstOrNot<MastOptions> MastFields, class Visit>
void for_each_field(MastFields& m, Visit&& visit) {
  visit("pan_continuous", m.pan_continuous, "true: turns without end, the pan limits are not used");
  visit("pan_min_rad", m.pan_min_rad, "rad; counter-clockwise from above is positive");
  visit("pan_max_rad", m.pan_max_rad, "rad");
  visit("pan_velocity_rad_s", m.pan_velocity_rad_s, "rad/s");
  visit("tilt_min_rad", m.tilt_min_rad, "rad; positive looks up");
  visit("tilt_max_rad", m.tilt_max_rad, "rad");
  visit("tilt_velocity_rad_s", m.tilt_velocity_rad_s, "rad/s");
  visit("height_min_m", m.height_min_m, "m; above the base");
  visit("height_max_m", m.height_max_m, "m");
  visit("height_velocity_m_s", m.height_velocity_m_s, "m/s");
  visit("sensor_offset_m", m.sensor_offset_m,
        "m; tilt joint to optical centre: x forward, y left, z up");
}

}  // namespace nbvopt
