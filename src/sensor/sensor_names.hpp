// The words of the sensor's options.
#pragma once

#include <optional>
#include <string>

#include "core/enum_names.hpp"
#include "nbvopt/fields/field_value.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<RayPattern> = std::to_array<EnumName<RayPattern>>({
    {RayPattern::pixel_centres, "pixel_centres"},
    {RayPattern::equal_angles, "equal_angles"},
});
template <>
inline constexpr auto kEnumNames<RangeAxis> = std::to_array<EnumName<RangeAxis>>({
    {RangeAxis::euclidean, "euclidean"},
    {RangeAxis::z_depth, "z_depth"},
});
template <>
inline constexpr auto kEnumNames<UncertaintyMode> = std::to_array<EnumName<UncertaintyMode>>({
    {UncertaintyMode::distance, "distance"},
    {UncertaintyMode::angle, "angle"},
    {UncertaintyMode::both, "both"},
});
template <>
inline constexpr auto kEnumNames<Counting> = std::to_array<EnumName<Counting>>({
    {Counting::per_ray, "per_ray"},
    {Counting::per_voxel, "per_voxel"},
});
template <>
inline constexpr auto kEnumNames<GainKind> = std::to_array<EnumName<GainKind>>({
    {GainKind::positive, "positive"},
    {GainKind::expected, "expected"},
    {GainKind::occlusion_aware, "occlusion_aware"},
    {GainKind::unobserved_voxel, "unobserved_voxel"},
    {GainKind::rear_side_voxel, "rear_side_voxel"},
    {GainKind::rear_side_entropy, "rear_side_entropy"},
    {GainKind::proximity_count, "proximity_count"},
    {GainKind::vasquez_gomez_area, "vasquez_gomez_area"},
    {GainKind::average_entropy, "average_entropy"},
    {GainKind::voxel_weight, "voxel_weight"},
});
template <>
inline constexpr auto kEnumNames<Visibility> = std::to_array<EnumName<Visibility>>({
    {Visibility::paper, "paper"},
    {Visibility::released, "released"},
});
template <>
inline constexpr auto kEnumNames<NoReturn> = std::to_array<EnumName<NoReturn>>({
    {NoReturn::clear, "clear"},
    {NoReturn::ignore, "ignore"},
});

/// Reads a gain's name or a weighted sum, as store() of fields does; value_of() is the way back.
std::string store(const FieldValue& value, GainChoice& field);
inline std::optional<FieldValue> value_of(const GainChoice& field) { return to_string(field); }

}  // namespace nbvopt
