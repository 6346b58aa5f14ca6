// The one list of the robot's fields, with the comments that the robot file shows.
#pragma once

#include <array>
#include <span>

#include "fields/field_table.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {

/// The fields of the sensor, in the order of the robot file.
inline constexpr auto kSensorFields = std::to_array<Field<SensorOptions>>({
    field<&SensorOptions::half_fov_horizontal_rad>("half_fov_horizontal_rad",
                                                   "rad; half the horizontal field of view"),
    field<&SensorOptions::half_fov_vertical_rad>("half_fov_vertical_rad",
                                                 "rad; half the vertical field of view"),
    field<&SensorOptions::horizontal_rays>("horizontal_rays",
                                           "rays; columns of the planning image"),
    field<&SensorOptions::vertical_rays>("vertical_rays", "rays; rows of the planning image"),
    field<&SensorOptions::horizontal_pixels>("horizontal_pixels",
                                             "pixels; width of the depth image for mapping"),
    field<&SensorOptions::vertical_pixels>("vertical_pixels",
                                           "pixels; height of the depth image for mapping"),
    field<&SensorOptions::range_min_m>("range_min_m", "m; D_min"),
    field<&SensorOptions::range_max_m>("range_max_m", "m; D_max"),
    field<&SensorOptions::focal_distance_m>("focal_distance_m",
                                            "m; D_F of Eq. 1, where the camera sees best"),
    field<&SensorOptions::uncertainty_half_fov_horizontal_rad>(
        "uncertainty_half_fov_horizontal_rad",
        "rad; what Eq. 5 divides by, 0: the half field of view"),
    field<&SensorOptions::uncertainty_half_fov_vertical_rad>(
        "uncertainty_half_fov_vertical_rad",
        "rad; what Eq. 6 divides by, 0: the half field of view"),
    field<&SensorOptions::uncertainty_mode>("uncertainty_mode",
                                            "distance (Eq. 2), angle (Eq. 7) or both (Eq. 8)"),
    field<&SensorOptions::normal_weight>(
        "normal_weight", "0 to 1; the share of how slantwise a surface is seen in u"),
    field<&SensorOptions::ray_pattern>("ray_pattern", "pixel_centres or equal_angles"),
    field<&SensorOptions::range_axis>("range_axis", "euclidean or z_depth"),
    field<&SensorOptions::counting>("counting", "per_ray or per_voxel (Eq. 13)"),
    field<&SensorOptions::gain>("gain",
                                "positive: the unknown is a wall (Eq. 12); expected: with a learnt "
                                "probability; another gain's name, or a sum"),
    field<&SensorOptions::visibility>("visibility",
                                      "paper or released: P_vis of the gains of Isler et al."),
    field<&SensorOptions::near_blocking>(
        "near_blocking", "true: an occupied voxel nearer than range_min_m blocks the ray"),
    field<&SensorOptions::no_return>(
        "no_return", "clear or ignore: what a ray without a return does to the map"),
    field<&SensorOptions::occupied_uncertainty>(
        "occupied_uncertainty", "0 to 1; u of an occupied voxel whose map carries none"),
});

/// The fields of the mast, in the order of the robot file.
inline constexpr auto kMastFields = std::to_array<Field<MastOptions>>({
    field<&MastOptions::pan_continuous>("pan_continuous",
                                        "true: turns without end, the pan limits are not used"),
    field<&MastOptions::pan_min_rad>("pan_min_rad",
                                     "rad; counter-clockwise from above is positive"),
    field<&MastOptions::pan_max_rad>("pan_max_rad", "rad"),
    field<&MastOptions::pan_velocity_rad_s>("pan_velocity_rad_s", "rad/s"),
    field<&MastOptions::tilt_min_rad>("tilt_min_rad", "rad; positive looks up"),
    field<&MastOptions::tilt_max_rad>("tilt_max_rad", "rad"),
    field<&MastOptions::tilt_velocity_rad_s>("tilt_velocity_rad_s", "rad/s"),
    field<&MastOptions::height_min_m>("height_min_m", "m; above the base"),
    field<&MastOptions::height_max_m>("height_max_m", "m"),
    field<&MastOptions::height_velocity_m_s>("height_velocity_m_s", "m/s"),
    field<&MastOptions::pan_axis_x_m>("pan_axis_x_m",
                                      "m; where the pan axis stands on the base: forward"),
    field<&MastOptions::pan_axis_y_m>("pan_axis_y_m", "m; left"),
    field<&MastOptions::sensor_offset_m>(
        "sensor_offset_m", "m; tilt joint to optical centre: x forward, y left, z up"),
});

inline std::span<const Field<SensorOptions>> fields_of(const SensorOptions&) {
  return kSensorFields;
}
inline std::span<const Field<MastOptions>> fields_of(const MastOptions&) { return kMastFields; }

/// The name of the block in files and messages.
inline const char* block_name(const SensorOptions&) { return "sensor"; }
inline const char* block_name(const MastOptions&) { return "mast"; }

}  // namespace nbvopt
