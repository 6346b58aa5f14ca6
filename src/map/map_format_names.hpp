// The words of the map file formats.
#pragma once

#include "core/enum_names.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<MapFormat> = std::to_array<EnumName<MapFormat>>({
    {MapFormat::uncertainty_ot, "uncertainty-ot"},
    {MapFormat::bt, "bt"},
    {MapFormat::colour_ot, "colour-ot"},
    {MapFormat::colour_ply, "ply"},
    {MapFormat::colour_pcd, "pcd"},
});

}  // namespace nbvopt
