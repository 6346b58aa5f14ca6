// The words of recordings.
#pragma once

#include "core/enum_names.hpp"
#include "nbvopt/map/recording.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<RecordingFormat> = std::to_array<EnumName<RecordingFormat>>({
    {RecordingFormat::tum, "tum"},
    {RecordingFormat::icl_nuim, "icl-nuim"},
    {RecordingFormat::seven_scenes, "7-scenes"},
    {RecordingFormat::scannet, "scannet"},
    {RecordingFormat::redwood, "redwood"},
    {RecordingFormat::replica, "replica"},
    {RecordingFormat::kitti, "kitti"},
    {RecordingFormat::named, "named"},
    {RecordingFormat::viewpoint, "viewpoint"},
    {RecordingFormat::map_frame, "map-frame"},
});

template <>
inline constexpr auto kEnumNames<PoseAxes> = std::to_array<EnumName<PoseAxes>>({
    {PoseAxes::optical, "optical"},
    {PoseAxes::body, "body"},
    {PoseAxes::opengl, "opengl"},
});

template <>
inline constexpr auto kEnumNames<UpAxis> = std::to_array<EnumName<UpAxis>>({
    {UpAxis::plus_z, "z"},
    {UpAxis::minus_z, "-z"},
    {UpAxis::plus_y, "y"},
    {UpAxis::minus_y, "-y"},
    {UpAxis::plus_x, "x"},
    {UpAxis::minus_x, "-x"},
});

}  // namespace nbvopt
