// The words for a camera link's axes in files, messages and on the command line.
#pragma once

#include <array>

#include "core/enum_names.hpp"
#include "nbvopt/mast/urdf.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<CameraAxes> = std::to_array<EnumName<CameraAxes>>({
    {CameraAxes::optical, "optical"},
    {CameraAxes::body, "body"},
});

}  // namespace nbvopt
