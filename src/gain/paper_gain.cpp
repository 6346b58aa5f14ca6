#include <algorithm>
#include <bit>

#include "gain/angle_part.hpp"
#include "gain/ray_gains.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {
namespace {

class PaperGain final : public GainModel {
 public:
  explicit PaperGain(const DepthCamera& camera) : counting_(camera.options().counting) {
    const UncertaintyModel uncertainty(camera.options());
    model_.distance_weight = uncertainty.distance_weight();
    model_.focal_distance_m = uncertainty.focal_distance_m();
    model_.angle_part = detail::angle_part(uncertainty, camera.rays());
  }

  std::string name() const override { return "paper"; }

  ViewGain gain(const RayHits& hits, GainScratch& scratch) const override {
    ViewGain view = detail::ray_gains(model_, hits, scratch.ray_gain);
    if (counting_ == Counting::per_voxel) count_voxels_once(hits, scratch, view);
    return view;
  }

 private:
  /// Equation (13) over distinct voxels: each counts with the best of its rays.
  static void count_voxels_once(const RayHits& hits, GainScratch& scratch, ViewGain& view) {
    // Open addressing, at most half full; a slot holds 1 + the voxel's best ray.
    const std::size_t slots = std::bit_ceil(2 * hits.size() + 1);
    scratch.best_ray.assign(slots, 0);
    for (std::uint32_t i = 0; i < hits.size(); ++i) {
      if (hits.kind[i] < HitKind::unknown) continue;
      std::size_t slot = (packed(hits.voxel[i]) * 0x9E3779B97F4A7C15U >> 20) & (slots - 1);
      std::uint32_t* best = &scratch.best_ray[slot];
      while (*best != 0 && hits.voxel[*best - 1] != hits.voxel[i]) {
        slot = (slot + 1) & (slots - 1);
        best = &scratch.best_ray[slot];
      }
      if (*best == 0 || scratch.ray_gain[i] > scratch.ray_gain[*best - 1]) *best = i + 1;
    }
    view.unknown_gain = 0.0;
    view.occupied_gain = 0.0;
    for (const std::uint32_t best : scratch.best_ray) {
      if (best == 0) continue;
      (hits.kind[best - 1] == HitKind::unknown ? view.unknown_gain : view.occupied_gain) +=
          scratch.ray_gain[best - 1];
    }
    view.gain = view.unknown_gain + view.occupied_gain;
  }

  Counting counting_;
  detail::RayGainModel model_;
};

}  // namespace

std::unique_ptr<GainModel> make_paper_gain(const DepthCamera& camera) {
  return std::make_unique<PaperGain>(camera);
}

}  // namespace nbvopt
