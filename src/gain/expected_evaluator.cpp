#include <algorithm>
#include <unordered_map>
#include <vector>

#include "gain/angle_part.hpp"
#include "gain/expected_parts.hpp"
#include "gain/normal_part.hpp"
#include "gain/passage_walk.hpp"
#include "gain/ray_passages.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {
namespace {

class ExpectedEvaluator final : public ViewEvaluator {
 public:
  ExpectedEvaluator(std::shared_ptr<const VoxelGrid> grid, const DepthCamera& camera,
                    const HazardTable& hazards, SimdLevel level)
      : grid_(std::move(grid)),
        camera_(camera),
        uncertainty_(camera.options()),
        passage_{hazards, uncertainty_.focal_distance_m()},
        angle_part_(detail::angle_part(uncertainty_, camera.rays())),
        unknown_u_old_(detail::unknown_without_normal_part(uncertainty_.normal_weight())),
        level_(level) {}

  std::string name() const override { return "exact"; }

  void add_parts(const Transform& T_map_sensor, const detail::AddExpectedPart& add) const {
    const SensorOptions& sensor = camera_.options();
    const RayBundle rays = make_bundle(camera_.rays(), T_map_sensor, sensor.near_blocking);
    detail::RayPassages passages;
    const detail::RayWalk walk =
        detail::pass_rays(*grid_, rays, sensor.occupied_uncertainty, passage_, passages, level_);
    detail::take_normal_part(*grid_, sensor.normal_weight, passages.end);
    for_each_part(walk, passages.end, add);
  }

  ViewGain evaluate(const Transform& T_map_sensor) const override {
    const SensorOptions& sensor = camera_.options();
    const RayBundle rays = make_bundle(camera_.rays(), T_map_sensor, sensor.near_blocking);
    thread_local detail::RayPassages passages;
    const detail::RayWalk walk =
        detail::pass_rays(*grid_, rays, sensor.occupied_uncertainty, passage_, passages, level_);
    detail::take_normal_part(*grid_, sensor.normal_weight, passages.end);
    ViewGain view;
    double unknown_gain = 0.0, occupied_gain = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool ends_occupied = passages.end.kind[i] == HitKind::occupied;
      unknown_gain += passages.probability[i] * (unknown_u_old_ - angle_part_[i]) -
                      uncertainty_.distance_weight() * passages.distance_uncertainty[i];
      if (ends_occupied) occupied_gain += passages.end_probability[i] * end_gain(passages.end, i);
      view.unknown_rays += passages.meets_unknown[i];
      view.occupied_rays += ends_occupied && passages.meets_unknown[i] == 0 ? 1 : 0;
    }
    view.free_rays = static_cast<int>(rays.size()) - view.unknown_rays - view.occupied_rays;
    if (sensor.counting == Counting::per_voxel) {
      count_voxels_once(walk, passages.end, unknown_gain, occupied_gain);
    }
    view.unknown_gain = unknown_gain;
    view.occupied_gain = occupied_gain;
    view.gain = unknown_gain + occupied_gain;
    return view;
  }

 private:
  /// Equation (12) of a ray that ends occupied.
  double end_gain(const RayHits& end, std::size_t i) const {
    return std::max(0.0, end.uncertainty[i] - u_new(i, end.distance_m[i]));
  }

  /// Equation (8) along ray i.
  double u_new(std::size_t i, double distance_m) const {
    return angle_part_[i] +
           uncertainty_.distance_weight() * uncertainty_.distance_uncertainty(distance_m);
  }

  /// Equation (13) over distinct voxels: each counts with the ray that is expected to bring most.
  void count_voxels_once(const detail::RayWalk& walk, const RayHits& end, double& unknown_gain,
                         double& occupied_gain) const {
    thread_local std::unordered_map<std::uint64_t, double> hidden, seen;
    hidden.clear();
    seen.clear();
    unknown_gain = occupied_gain = 0.0;
    // In the order of the rays, so that the sum does not depend on the table's.
    const auto raise = [](double& best, double gain, double& sum) {
      if (gain <= best) return;
      sum += gain - best;
      best = gain;
    };
    for_each_part(walk, end, [&](VoxelKey voxel, VoxelState state, double gain) {
      if (state == VoxelState::occupied) {
        raise(seen[packed(voxel)], gain, occupied_gain);
      } else {
        raise(hidden[packed(voxel)], gain, unknown_gain);
      }
    });
  }

  /// Calls add(voxel, state, gain) with what each voxel on each ray is expected to bring it.
  template <class Add>
  void for_each_part(const detail::RayWalk& walk, const RayHits& end, const Add& add) const {
    const RayBundle& rays = *walk.rays;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (end.kind[i] == HitKind::blocked) continue;
      detail::ScalarRay ray(walk, {end.direction_x[i], end.direction_y[i], end.direction_z[i]});
      double transmittance = 1.0;
      const auto visit = [&](const detail::PassagePiece& piece) {
        const detail::PassedPiece passed =
            detail::pass_piece(piece, passage_.hazards, rays.range_min_m[i], transmittance);
        if (passed.probability > 0.0) {
          add(piece.voxel, piece.is_unknown ? VoxelState::unknown : VoxelState::free,
              passed.probability * (unknown_u_old_ - u_new(i, passed.mean_distance_m)));
        }
        return true;
      };
      const auto ends_at = [&](double leaves_m) { return leaves_m >= rays.range_min_m[i]; };
      detail::walk_passage(walk, passage_.hazards, ray, end.direction_z[i], rays.range_max_m[i],
                           visit, ends_at);
      if (end.kind[i] == HitKind::occupied) {
        add(end.voxel[i], VoxelState::occupied, transmittance * end_gain(end, i));
      }
    }
  }

  std::shared_ptr<const VoxelGrid> grid_;  // shared with the caller, who publishes it
  DepthCamera camera_;
  UncertaintyModel uncertainty_;
  detail::PassageModel passage_;
  std::vector<double> angle_part_;  ///< of each ray's u
  double unknown_u_old_;            ///< without the part of normals that are not known yet
  SimdLevel level_;
};

}  // namespace

std::unique_ptr<ViewEvaluator> make_expected_evaluator(std::shared_ptr<const VoxelGrid> grid,
                                                       const DepthCamera& camera,
                                                       const HazardTable& hazards,
                                                       SimdLevel level) {
  return std::make_unique<ExpectedEvaluator>(std::move(grid), camera, hazards, level);
}

void detail::add_expected_parts(const std::shared_ptr<const VoxelGrid>& grid,
                                const DepthCamera& camera, const HazardTable& hazards,
                                const Transform& T_map_sensor, const AddExpectedPart& add) {
  ExpectedEvaluator(grid, camera, hazards, SimdLevel::best).add_parts(T_map_sensor, add);
}

}  // namespace nbvopt
