// The words of depth images.
#pragma once

#include "core/enum_names.hpp"
#include "nbvopt/map/depth_image.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<LargestValue> = std::to_array<EnumName<LargestValue>>({
    {LargestValue::no_return, "no_return"},
    {LargestValue::invalid, "invalid"},
    {LargestValue::far, "far"},
});

}  // namespace nbvopt
