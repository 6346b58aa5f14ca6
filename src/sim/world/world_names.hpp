// The words of the world's options.
#pragma once

#include "core/enum_names.hpp"
#include "nbvopt/sim/world.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<WorldGeometry> = std::to_array<EnumName<WorldGeometry>>({
    {WorldGeometry::visual, "visual"},
    {WorldGeometry::collision, "collision"},
});

}  // namespace nbvopt
