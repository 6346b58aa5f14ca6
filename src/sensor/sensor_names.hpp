// The words of the sensor's options.
#pragma once

#include "core/enum_names.hpp"
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
});
template <>
inline constexpr auto kEnumNames<NoReturn> = std::to_array<EnumName<NoReturn>>({
    {NoReturn::clear, "clear"},
    {NoReturn::ignore, "ignore"},
});

}  // namespace nbvopt
