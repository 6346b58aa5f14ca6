// Which patches of a panorama a view may touch.
#pragma once

#include <cstdint>
#include <vector>

#include "gain/panorama_directions.hpp"

namespace nbvopt::detail {

/// The patches that may have hits within the half fields of view, in their order. A hit of patch i
/// lies within radius[i] of the patch's axis as seen from where it was cast, at least
/// 1 / nearness[i] away.
void patches_in_view(const PanoramaDirections& directions, const std::vector<float>& radius,
                     const std::vector<float>& nearness, const PanoramaView& view,
                     double half_fov_h_rad, double half_fov_v_rad, std::vector<std::uint32_t>& ids);

}  // namespace nbvopt::detail
