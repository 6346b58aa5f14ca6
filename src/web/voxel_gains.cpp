#include "web/voxel_gains.hpp"

#include <algorithm>
#include <unordered_map>

#include "gain/expected_parts.hpp"
#include "gain/normal_part.hpp"
#include "gain/volumetric_gains.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {
namespace {

/// Gathers what voxels bring.
class Gathered {
 public:
  enum class Of { all_rays, best_ray };

  explicit Gathered(Of of) : of_(of) {}

  void add(VoxelKey key, VoxelState state, double gain) {
    if (gain <= 0.0) return;
    const auto [found, is_new] = place_.try_emplace(packed(key), voxels_.size());
    if (is_new) {
      voxels_.push_back({key, state, gain});
      return;
    }
    double& sum = voxels_[found->second].gain;
    sum = of_ == Of::best_ray ? std::max(sum, gain) : sum + gain;
  }

  void add(const Gathered& other, double weight) {
    for (const VoxelGain& voxel : other.voxels_) add(voxel.key, voxel.state, weight * voxel.gain);
  }

  std::vector<VoxelGain> take() { return std::move(voxels_); }

 private:
  const Of of_;
  std::vector<VoxelGain> voxels_;
  std::unordered_map<std::uint64_t, std::size_t> place_;  ///< of each in voxels_
};

void gather_positive(const VoxelGrid& grid, const DepthCamera& camera,
                     const Transform& T_map_sensor, Gathered& gathered) {
  const SensorOptions& sensor = camera.options();
  RayHits hits;
  cast_rays(grid, make_bundle(camera.rays(), T_map_sensor, sensor.near_blocking),
            sensor.occupied_uncertainty, hits);
  detail::take_normal_part(grid, sensor.normal_weight, hits);
  GainScratch scratch;
  make_paper_gain(camera)->gain(hits, scratch);
  for (std::size_t ray = 0; ray < hits.size(); ++ray) {
    if (hits.kind[ray] < HitKind::unknown) continue;
    gathered.add(hits.voxel[ray],
                 hits.kind[ray] == HitKind::occupied ? VoxelState::occupied : VoxelState::unknown,
                 scratch.ray_gain[ray]);
  }
}

}  // namespace

VoxelGains voxel_gains(const std::shared_ptr<const VoxelGrid>& grid, const SensorOptions& sensor,
                       const HazardTable& hazards, const Transform& T_map_sensor) {
  const DepthCamera camera(sensor);
  const detail::SurfaceDistances distances(grid, detail::kSurfaceReach_m);
  detail::ViewRays rays;
  if (!sensor.gain.is_of_paper()) rays.walk(*grid, camera, T_map_sensor);
  const detail::SeenView view{rays, sensor, *grid, distances, T_map_sensor.translation()};
  const Gathered::Of of_paper =
      sensor.counting == Counting::per_voxel ? Gathered::Of::best_ray : Gathered::Of::all_rays;

  Gathered all(Gathered::Of::all_rays);
  for (const GainTerm& term : sensor.gain.terms()) {
    const GainChoice alone(term.kind);
    Gathered of_term(alone.is_of_paper() ? of_paper : Gathered::Of::all_rays);
    if (alone == GainKind::positive) {
      gather_positive(*grid, camera, T_map_sensor, of_term);
    } else if (alone == GainKind::expected) {
      detail::add_expected_parts(
          grid, camera, hazards, T_map_sensor,
          [&](VoxelKey voxel, VoxelState state, double gain) { of_term.add(voxel, state, gain); });
    } else if (!detail::add_parts(term.kind, view, [&](const detail::RayVoxel& voxel, double part) {
                 of_term.add(voxel.key, voxel.state, part);
               })) {
      return {{}, "the gain " + to_string(alone) + " is no sum over voxels: none has a part in it"};
    }
    all.add(of_term, term.weight);
  }
  return {all.take(), ""};
}

}  // namespace nbvopt
