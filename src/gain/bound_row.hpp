// Sums over rays of the most that each can bring, for a row of bins of pan at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nbvopt::detail {

/// Where the rays of the views of a range of tilts go, as seen from the first bin of pan: the
/// windows of 2 x 2 cells (ConeCells::windows()) that together hold all directions of each ray.
struct RayWindows {
  std::vector<std::int32_t> offset;  ///< of a window from that of bin 0
  std::vector<std::int32_t> end;     ///< of each ray's offsets
  std::vector<float> angle_part;     ///< of u_new, of each ray
};

/// What the views of bins begin to end - 1 bring at most, sums[0] that of bin `begin`. `windows`
/// must be readable for 64 bins from every offset on.
void bound_row(const RayWindows& rays, const float* windows, int begin, int end, float* sums);

}  // namespace nbvopt::detail
