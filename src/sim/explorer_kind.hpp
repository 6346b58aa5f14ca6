// Who chooses where the base drives.
#pragma once

#include "core/enum_names.hpp"

namespace nbvopt {

enum class ExplorerKind {
  plane,               ///< frontiers in the lidar's map, as explore()
  volume,              ///< views that show much of the unknown, as explore_volume()
  volume_tekniker,     ///< the same as the paper's authors ran it
  volume_after_plane,  ///< the second from where the first ends
  views,               ///< what the camera has to learn, as explore_views()
};

template <>
inline constexpr auto kEnumNames<ExplorerKind> = std::to_array<EnumName<ExplorerKind>>({
    {ExplorerKind::plane, "2d"},
    {ExplorerKind::volume, "3d"},
    {ExplorerKind::volume_tekniker, "3d-tekniker"},
    {ExplorerKind::volume_after_plane, "3d-after-2d"},
    {ExplorerKind::views, "nbv"},
});

}  // namespace nbvopt
