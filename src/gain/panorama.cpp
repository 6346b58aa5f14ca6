#include "nbvopt/gain/panorama.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

#include "gain/panorama_directions.hpp"
#include "gain/panorama_layer.hpp"
#include "gain/panorama_sum.hpp"
#include "gain/voxel_sum.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using detail::PanoramaLayer;
using detail::PanoramaSum;
using detail::PanoramaView;

/// Places along a line, at most a spacing apart, between which values are blended.
struct Stations {
  double first = 0.0;
  double step = 0.0;  ///< 0: one place only
  int count = 1;

  /// `with_middle`: where there are more than two, the middle is one of them.
  Stations(double from, double to, double spacing, bool with_middle) : first(from) {
    const double length = to - from;
    if (!(length > 0.0 && spacing > 0.0)) return;
    int steps = std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-9)));
    if (with_middle && steps > 1) steps += steps % 2;
    step = length / steps;
    count = steps + 1;
  }
  double at(int i) const { return first + i * step; }

  /// The place before x, and the weight of the next one with its slope: a smooth step.
  struct Blend {
    int before;
    double next;
    double next_slope;
  };
  Blend blend(double x) const {
    constexpr double kRounding = 1e-9;
    if (count == 1) return {0, 0.0, 0.0};
    const double place = std::clamp((x - first) / step, 0.0, count - 1.0);
    const int before = std::min(static_cast<int>(place), count - 2);
    const double between = place - before;
    // Rounding must not ask for a layer that does not count.
    const double t =
        std::abs(between - std::round(between)) < kRounding ? std::round(between) : between;
    return {before, t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / step};
  }
};

/// A layer's share in the gain at a joint position.
struct LayerWeight {
  int layer;
  double weight;
  Eigen::Vector3d gradient;
};

/// Layers a voxel apart, or half a voxel where voxels are large.
double layer_spacing_m(double resolution_m, const PanoramaOptions& options) {
  constexpr double kLargeVoxel_m = 0.1 - 1e-9;
  return options.layer_spacing * resolution_m * (resolution_m >= kLargeVoxel_m ? 0.5 : 1.0);
}

/// The box, its pans those that a turning base sees as well.
JointBox with_turn(JointBox box, double turn_rad) {
  box.min[0] += std::min(0.0, turn_rad);
  box.max[0] += std::max(0.0, turn_rad);
  return box;
}

}  // namespace

void PanoramaOptions::validate() const {
  const auto require = [](double value, const char* name) {
    if (std::isfinite(value) && value > 0.0) return;
    throw InputError(std::string("panorama: ") + name + " must be a finite number above 0");
  };
  require(ray_spacing, "ray_spacing");
  require(layer_spacing, "layer_spacing");
  require(smoothing, "smoothing");
}

class Panorama::Impl {
 public:
  Impl(std::shared_ptr<const VoxelGrid> grid, const SensorOptions& sensor, const MovingMast& mast,
       const JointBox& box, const PanoramaOptions& options, const HazardTable& hazards)
      : grid_(std::move(grid)),
        mast_(mast),
        counting_(sensor.counting),
        model_(sensor, grid_->lattice().resolution_m()),
        kernel_(detail::panorama_kernel(options.double_precision)),
        tau_h_rad_(options.smoothing * options.ray_spacing * model_.ray_spacing_h_rad),
        tau_v_rad_(options.smoothing * options.ray_spacing * model_.ray_spacing_v_rad),
        layer_spacing_m_(layer_spacing_m(grid_->lattice().resolution_m(), options)),
        longest_time_s_(mast.longest_arrival_time_s(box)),
        rays_per_patch_(detail::HitBlock::kSize * options.ray_spacing * options.ray_spacing),
        passage_{hazards, sensor.focal_distance_m, false},
        directions_(directions(box, options)),
        // Searches sample the middle height, which then takes one layer instead of two.
        heights_(box.min[2], box.max[2], layer_spacing_m_, true),
        times_(0.0, longest_time_s_, time_spacing_s(), false),
        caster_{.grid = *grid_,
                .directions = directions_,
                .R_map_base = mast_.T_map_mast(0.0).linear(),
                .range_min_m = sensor.range_min_m,
                .range_max_m = sensor.longest_range_m(),
                .near_blocking = sensor.near_blocking,
                .occupied_uncertainty = sensor.occupied_uncertainty,
                .weight_distance = model_.weight_distance,
                .normal_weight = sensor.normal_weight,
                .focal_distance_m = model_.focal_distance_m,
                .farthest_view_m = farthest_view_m(),
                .per_voxel = counting_ == Counting::per_voxel,
                .has_lever = lever_m().squaredNorm() > 0.0,
                .passage = sensor.gain == GainKind::expected ? &passage_ : nullptr},
        layers_(static_cast<std::size_t>(heights_.count) * static_cast<std::size_t>(times_.count)) {
  }

  /// The sum at q, with its gradient unless null.
  double gain(const JointPosition& q, double smoothing, Eigen::Vector3d* gradient) {
    if (!(smoothing > 0.0 && smoothing <= 1.0)) {
      throw UsageError("panorama: smoothing is a share of the widest, give above 0 and at most 1");
    }
    const SensorMotion motion = gradient ? mast_.sensor_motion(q) : SensorMotion{};
    double gain = 0.0;
    if (gradient) gradient->setZero();
    for_each_layer(q, smoothing,
                   [&](const LayerWeight& weight, const PanoramaLayer& layer,
                       const PanoramaView& view, std::span<const std::uint32_t> ids) {
                     thread_local std::vector<std::uint32_t> blocks;
                     layer.blocks_of(ids, blocks);
                     const PanoramaSum sum = layer_sum(layer, view, blocks, gradient != nullptr);
                     gain += weight.weight * sum.gain;
                     if (gradient) *gradient += weighted_gradient(weight, sum, motion);
                   });
    return gain;
  }

  /// A ray of a layer stands for ray_spacing^2 rays at most twice as dense in the corners of the
  /// image, each of which gains less than 1; another factor of 2 covers hits that are seen from
  /// nearer than they were cast from.
  double patch_gain_bound() const { return 4.0 * rays_per_patch_; }

  std::size_t patch_count() const { return directions_.patch_count(); }

  void patch_gains(const JointPosition& q, Eigen::VectorXd& gains, Eigen::MatrixXd* derivatives) {
    if (counting_ == Counting::per_voxel) {
      throw UsageError(
          "panorama: the gains of patches add up per ray only, use the counting per_ray");
    }
    const auto patches = static_cast<Eigen::Index>(patch_count());
    gains.setZero(patches);
    if (derivatives) derivatives->setZero(patches, 3);
    const SensorMotion motion = mast_.sensor_motion(q);
    for_each_layer(q, 1.0,
                   [&](const LayerWeight& weight, const PanoramaLayer& layer,
                       const PanoramaView& view, std::span<const std::uint32_t> ids) {
                     for (const std::uint32_t id : ids) {
                       thread_local std::vector<std::uint32_t> blocks;
                       layer.blocks_of(std::span(&id, 1), blocks);
                       const PanoramaSum sum = layer_sum(layer, view, blocks, true);
                       gains[id] += weight.weight * sum.gain;
                       if (derivatives)
                         derivatives->row(id) += weighted_gradient(weight, sum, motion).transpose();
                     }
                   });
  }

 private:
  /// Visits the layers that count at q, with all cast that the view needs: the patches `ids`.
  template <typename Visit>
  void for_each_layer(const JointPosition& q, double smoothing, const Visit& visit) {
    const Transform T_map_sensor = mast_.T_map_sensor(q);
    for (const LayerWeight& weight : weights(q)) {
      if (weight.weight == 0.0) continue;  // its slope is 0 there as well
      const PanoramaView view = view_of(T_map_sensor, weight.layer, smoothing);
      thread_local std::vector<std::uint32_t> ids;
      const PanoramaLayer& layer = select(weight.layer, view, ids);
      visit(weight, layer, view, std::span<const std::uint32_t>(ids));
    }
  }

  detail::PanoramaDirections directions(const JointBox& box, const PanoramaOptions& options) const {
    const JointBox seen = with_turn(box, mast_.mast_twist().wz_rad_s * longest_time_s_);
    return {detail::directions_in_reach(seen, model_.half_fov_h_rad + tau_h_rad_,
                                        model_.half_fov_v_rad + tau_v_rad_),
            options.ray_spacing * model_.ray_spacing_h_rad,
            options.ray_spacing * model_.ray_spacing_v_rad,
            box,
            lever_m(),
            mast_.T_map_mast(0.0).linear()};
  }

  const Eigen::Vector3d& lever_m() const { return mast_.mast().options().sensor_offset_m; }

  /// How far the optical centre may be from where a layer was cast that it uses: a spacing up the
  /// mast, another along the base's path, and opposite to the lever arm that was cast with.
  double farthest_view_m() const {
    return std::hypot(heights_.step, times_.step * mast_.mast_twist().speed_m_s()) +
           2.0 * lever_m().norm();
  }

  /// How long the base takes from layer to layer; 0 where it stays.
  double time_spacing_s() const {
    const double speed_m_s = mast_.mast_twist().speed_m_s();
    return speed_m_s > 0.0 ? layer_spacing_m_ / speed_m_s : 0.0;
  }

  std::array<LayerWeight, 4> weights(const JointPosition& q) const {
    const Stations::Blend height = heights_.blend(q.height_m);
    const Stations::Blend time = times_.blend(mast_.arrival_time_s(q));
    const Eigen::Vector3d height_slope = height.next_slope * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d time_slope =
        times_.count == 1 ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                          : Eigen::Vector3d(time.next_slope * mast_.arrival_time_gradient(q));
    std::array<LayerWeight, 4> result{};
    for (int i = 0; i < 4; ++i) {
      const int up = i & 1;
      const int later = i >> 1;
      const double h = up ? height.next : 1.0 - height.next;
      const double t = later ? time.next : 1.0 - time.next;
      result[static_cast<std::size_t>(i)] = {
          std::min(time.before + later, times_.count - 1) * heights_.count +
              std::min(height.before + up, heights_.count - 1),
          h * t, (up ? t : -t) * height_slope + (later ? h : -h) * time_slope};
    }
    return result;
  }

  PanoramaView view_of(const Transform& T_map_sensor, int layer, double smoothing) const {
    return {T_map_sensor.linear().transpose(), T_map_sensor.translation() - centre_map_m(layer),
            smoothing * tau_h_rad_, smoothing * tau_v_rad_};
  }

  Eigen::Vector3d centre_map_m(int layer) const {
    return mast_.T_map_mast(times_.at(layer / heights_.count)) *
           Eigen::Vector3d(0.0, 0.0, heights_.at(layer % heights_.count));
  }

  /// The layer, with all cast that the view needs: those patches are in `ids`.
  const PanoramaLayer& select(int index, const PanoramaView& view,
                              std::vector<std::uint32_t>& ids) {
    const std::scoped_lock lock(mutex_);
    std::unique_ptr<PanoramaLayer>& layer = layers_[static_cast<std::size_t>(index)];
    if (!layer) layer = std::make_unique<PanoramaLayer>(caster_, centre_map_m(index));
    layer->patches_in_view(view, model_.half_fov_h_rad + view.tau_h_rad,
                           model_.half_fov_v_rad + view.tau_v_rad, ids);
    layer->cast(ids);
    return *layer;
  }

  /// The sum over blocks of a layer; its derivatives are 0 unless they are asked for.
  PanoramaSum layer_sum(const PanoramaLayer& layer, const PanoramaView& view,
                        std::span<const std::uint32_t> blocks, bool with_motion) const {
    if (counting_ == Counting::per_voxel) {
      return detail::voxel_sum(kernel_, model_, view, layer, blocks, with_motion);
    }
    if (with_motion) return kernel_.gain_and_motion(model_, view, layer.blocks(), blocks);
    return {.gain = kernel_.gain(model_, view, layer.blocks(), blocks)};
  }

  /// By each joint, of the layer's weight times its sum.
  static Eigen::Vector3d weighted_gradient(const LayerWeight& weight, const PanoramaSum& sum,
                                           const SensorMotion& motion) {
    Eigen::Vector3d by_joint;
    for (std::size_t i = 0; i < 3; ++i) {
      by_joint[static_cast<Eigen::Index>(i)] =
          -(motion.angular[i].dot(sum.torque) + motion.linear[i].dot(sum.force));
    }
    return weight.weight * by_joint + sum.gain * weight.gradient;
  }

  std::shared_ptr<const VoxelGrid> grid_;
  MovingMast mast_;
  Counting counting_;
  detail::PanoramaModel model_;
  detail::PanoramaKernel kernel_;
  double tau_h_rad_, tau_v_rad_;
  double layer_spacing_m_;
  double longest_time_s_;
  double rays_per_patch_;  ///< of the sensor's
  detail::PassageModel passage_;
  detail::PanoramaDirections directions_;
  Stations heights_, times_;  ///< of the layers, heights running fastest
  detail::LayerCaster caster_;
  std::mutex mutex_;  ///< guards the layers; what was cast of one is read without it
  std::vector<std::unique_ptr<PanoramaLayer>> layers_;
};

Panorama::Panorama(std::shared_ptr<const VoxelGrid> grid, const SensorOptions& sensor,
                   const MovingMast& mast, const JointBox& box, const PanoramaOptions& options,
                   const HazardTable& hazards) {
  sensor.validate();
  options.validate();
  impl_ = std::make_unique<Impl>(std::move(grid), sensor, mast, box, options, hazards);
}

Panorama::~Panorama() = default;

double Panorama::gain(const JointPosition& q, double smoothing) const {
  return impl_->gain(q, smoothing, nullptr);
}

double Panorama::gain(const JointPosition& q, Eigen::Vector3d& gradient, double smoothing) const {
  return impl_->gain(q, smoothing, &gradient);
}

Eigen::Index Panorama::patch_count() const {
  return static_cast<Eigen::Index>(impl_->patch_count());
}

void Panorama::patch_gains(const JointPosition& q, Eigen::VectorXd& gains,
                           Eigen::MatrixXd* derivatives) const {
  impl_->patch_gains(q, gains, derivatives);
}

double Panorama::patch_gain_bound() const { return impl_->patch_gain_bound(); }

}  // namespace nbvopt
