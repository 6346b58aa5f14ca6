// Who chooses where the base drives.
#pragma once

#include "core/enum_names.hpp"

namespace nbvopt {

enum class ExplorerKind {
  plane,  ///< frontiers in the lidar's map, as explore()
};

template <>
inline constexpr auto kEnumNames<ExplorerKind> = std::to_array<EnumName<ExplorerKind>>({
    {ExplorerKind::plane, "2d"},
});

}  // namespace nbvopt
