#include "gain/ray_passages.hpp"

#include "gain/camera_pose_check.hpp"

namespace nbvopt::detail {

void RayPassages::resize(std::size_t n) {
  end.resize(n);
  meets_unknown.resize(n);
  for (std::vector<float>* values : {&end_probability, &probability, &distance_uncertainty,
                                     &moment1_m, &moment2_m2, &moment3_m3}) {
    values->resize(n);
  }
}

RayWalk pass_rays(const VoxelGrid& grid, const RayBundle& rays, double occupied_uncertainty,
                  const PassageModel& model, RayPassages& passages, SimdLevel level) {
  check_camera_pose(rays.T_map_rays, grid.lattice());
  passages.resize(rays.size());
  const PassageKernel kernel = level == SimdLevel::scalar ? scalar_passage_kernel()
                                                          : simd_passage_kernel(hwy_targets(level));
  const RayBounds bounds = kernel.rotate_and_bound(rays, passages.end);
  RayWalk walk = make_walk(grid, rays, occupied_uncertainty, bounds);
  kernel.walk(walk, model, passages);
  return walk;
}

}  // namespace nbvopt::detail
