#include "web/voxel_gains.hpp"

#include <algorithm>
#include <unordered_map>

#include "gain/normal_part.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {

std::vector<VoxelGain> voxel_gains(const VoxelGrid& grid, const SensorOptions& sensor,
                                   const Transform& T_map_sensor) {
  const DepthCamera camera(sensor);
  RayHits hits;
  cast_rays(grid, make_bundle(camera.rays(), T_map_sensor, sensor.near_blocking),
            sensor.occupied_uncertainty, hits);
  detail::take_normal_part(grid, sensor.normal_weight, hits);
  GainScratch scratch;
  make_paper_gain(camera)->gain(hits, scratch);

  std::vector<VoxelGain> gains;
  std::unordered_map<std::uint64_t, std::size_t> place;  // of each voxel in `gains`
  for (std::size_t ray = 0; ray < hits.size(); ++ray) {
    const double gain = scratch.ray_gain[ray];
    if (hits.kind[ray] < HitKind::unknown || gain <= 0.0) continue;
    const auto [found, is_new] = place.try_emplace(packed(hits.voxel[ray]), gains.size());
    if (is_new) {
      gains.push_back({hits.voxel[ray], hits.kind[ray], gain});
      continue;
    }
    double& sum = gains[found->second].gain;
    sum = sensor.counting == Counting::per_voxel ? std::max(sum, gain) : sum + gain;
  }
  return gains;
}

}  // namespace nbvopt
