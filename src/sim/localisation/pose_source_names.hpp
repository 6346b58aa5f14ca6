// The words of the pose sources.
#pragma once

#include "core/enum_names.hpp"
#include "nbvopt/sim/localisation.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<PoseSource> = std::to_array<EnumName<PoseSource>>({
    {PoseSource::truth, "truth"},
    {PoseSource::odom, "odom"},
    {PoseSource::slam, "slam"},
});

}  // namespace nbvopt
