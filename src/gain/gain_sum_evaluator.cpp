#include "gain/gain_sum_evaluator.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "gain/volumetric_gains.hpp"

namespace nbvopt::detail {
namespace {

void count_rays(const ViewRays& rays, ViewGain& view) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::span<const RayVoxel> ray = rays.ray(i);
    const bool meets_unknown =
        std::ranges::find(ray, VoxelState::unknown, &RayVoxel::state) != ray.end();
    view.unknown_rays += meets_unknown ? 1 : 0;
    view.occupied_rays += !meets_unknown && ends_occupied(ray) ? 1 : 0;
  }
  view.free_rays = static_cast<int>(rays.size()) - view.unknown_rays - view.occupied_rays;
}

class GainSumEvaluator final : public ViewEvaluator {
 public:
  GainSumEvaluator(const std::shared_ptr<const VoxelGrid>& grid, const DepthCamera& camera,
                   const HazardTable& hazards)
      : grid_(grid), camera_(camera), distances_(grid, kSurfaceReach_m) {
    for (const GainTerm& term : camera.options().gain.terms()) {
      const GainChoice alone(term.kind);
      if (!alone.is_of_paper()) {
        volumetric_.push_back(term);
        continue;
      }
      SensorOptions sensor = camera.options();
      sensor.gain = alone;
      of_paper_.push_back({make_exact_evaluator(grid, DepthCamera(sensor), hazards), term.weight});
    }
  }

  std::string name() const override { return "exact"; }

  ViewGain evaluate(const Transform& T_map_sensor) const override {
    // Storage of a view's rays, kept a thread.
    thread_local ViewRays rays;
    rays.walk(*grid_, camera_, T_map_sensor);
    ViewGain view;
    count_rays(rays, view);
    view.gain = 0.0;
    const SeenView seen{rays, camera_.options(), *grid_, distances_, T_map_sensor.translation()};
    for (const GainTerm& term : volumetric_) {
      view.gain += term.weight * volumetric_gain(term.kind, seen);
    }
    for (const WeightedEvaluator& part : of_paper_) {
      view.gain += part.weight * part.evaluator->evaluate(T_map_sensor).gain;
    }
    return view;
  }

 private:
  struct WeightedEvaluator {
    std::unique_ptr<ViewEvaluator> evaluator;
    double weight;
  };

  std::shared_ptr<const VoxelGrid> grid_;  // shared with the caller, who publishes it
  DepthCamera camera_;
  SurfaceDistances distances_;
  std::vector<GainTerm> volumetric_;
  std::vector<WeightedEvaluator> of_paper_;
};

}  // namespace

std::unique_ptr<ViewEvaluator> make_gain_sum_evaluator(const std::shared_ptr<const VoxelGrid>& grid,
                                                       const DepthCamera& camera,
                                                       const HazardTable& hazards) {
  return std::make_unique<GainSumEvaluator>(grid, camera, hazards);
}

}  // namespace nbvopt::detail
