#include "gain/gain_sum_evaluator.hpp"
#include "gain/normal_part.hpp"
#include "nbvopt/gain/view_evaluator.hpp"

namespace nbvopt {
namespace {

class ExactEvaluator final : public ViewEvaluator {
 public:
  ExactEvaluator(std::shared_ptr<const VoxelGrid> grid, const DepthCamera& camera,
                 const std::string& gain_model, SimdLevel level)
      : grid_(std::move(grid)),
        camera_(camera),
        gain_model_(make_gain_model(gain_model, camera_)),
        level_(level) {}

  std::string name() const override { return "exact"; }

  ViewGain evaluate(const Transform& T_map_sensor) const override {
    const RayBundle rays =
        make_bundle(camera_.rays(), T_map_sensor, camera_.options().near_blocking);
    // Storage of a view's rays, kept a thread: it is as large as the image, not as the map.
    thread_local RayHits hits;
    thread_local GainScratch scratch;
    cast_rays(*grid_, rays, camera_.options().occupied_uncertainty, hits, level_);
    detail::take_normal_part(*grid_, camera_.options().normal_weight, hits);
    return gain_model_->gain(hits, scratch);
  }

 private:
  std::shared_ptr<const VoxelGrid> grid_;  // shared with the caller, who publishes it
  DepthCamera camera_;
  std::unique_ptr<GainModel> gain_model_;
  SimdLevel level_;
};

}  // namespace

std::unique_ptr<ViewEvaluator> make_exact_evaluator(std::shared_ptr<const VoxelGrid> grid,
                                                    const DepthCamera& camera,
                                                    const std::string& gain_model,
                                                    SimdLevel level) {
  return std::make_unique<ExactEvaluator>(std::move(grid), camera, gain_model, level);
}

std::unique_ptr<ViewEvaluator> make_exact_evaluator(std::shared_ptr<const VoxelGrid> grid,
                                                    const DepthCamera& camera,
                                                    const HazardTable& hazards) {
  if (camera.options().gain == GainKind::expected) {
    return make_expected_evaluator(std::move(grid), camera, hazards);
  }
  if (camera.options().gain == GainKind::positive) {
    return make_exact_evaluator(std::move(grid), camera);
  }
  return detail::make_gain_sum_evaluator(grid, camera, hazards);
}

}  // namespace nbvopt
