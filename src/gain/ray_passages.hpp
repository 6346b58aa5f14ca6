// Rays that go on through unknown space: with which probability they meet a surface there, and
// what is behind it.
#pragma once

#include <vector>

#include "gain/ray_walk.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/gain/ray_caster.hpp"

namespace nbvopt::detail {

/// The hazards, and what Eq. 1 and 2 need.
struct PassageModel {
  HazardTable hazards;
  double focal_distance_m = 1.0;
  bool with_uncertainty = true;  ///< whether RayPassages::distance_uncertainty is wanted
};

/// Of each ray, structure of arrays; the storage is reused.
///
/// A ray meets the j-th piece of unknown space of length L_j with probability
/// P_j = T_j (1 - exp(-l_j L_j)), T_1 = 1, T_(j+1) = T_j exp(-l_j L_j), at the mean distance
/// s_j = a_j + 1 / l_j - L_j / (exp(l_j L_j) - 1) from the origin. What lies nearer than range_min
/// attenuates, but is not seen: it has no part in the sums.
struct RayPassages {
  RayHits end;  ///< the first occupied voxel, or none, or blocked: never unknown
  std::vector<std::uint8_t> meets_unknown;  ///< whether an unknown voxel lies in range before it
  std::vector<float> end_probability;       ///< T at the end
  std::vector<float> probability;           ///< sum P_j
  std::vector<float> distance_uncertainty;  ///< sum P_j u_d(s_j), Eq. 2
  std::vector<float> moment1_m, moment2_m2, moment3_m3;  ///< sum P_j s_j^k

  void resize(std::size_t n);
};

/// Voxels by which leaps stop short of what they could, so that no free voxel that touches an
/// unknown one is skipped.
inline constexpr int kEdgeMargin = 1;

/// An implementation of the walk.
struct PassageKernel {
  RayBounds (*rotate_and_bound)(const RayBundle& rays, RayHits& hits);
  void (*walk)(const RayWalk& walk, const PassageModel& model, RayPassages& passages);
};
PassageKernel scalar_passage_kernel();
PassageKernel simd_passage_kernel(std::int64_t targets);

/// Casts every ray of the bundle as cast_rays() does, but through unknown voxels. Blocking by
/// occupied voxels before range_min is as there. Throws as cast_rays() does. Returns what it walked
/// on, for those who walk again.
RayWalk pass_rays(const VoxelGrid& grid, const RayBundle& rays, double occupied_uncertainty,
                  const PassageModel& model, RayPassages& passages,
                  SimdLevel level = SimdLevel::best);

}  // namespace nbvopt::detail
