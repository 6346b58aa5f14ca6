// The sums over a layer's hits that are in view, and their derivatives for a motion of the sensor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt::detail {

/// Hits of 4 x 4 rays, structure of arrays; a lane without a hit has no area.
struct alignas(64) HitBlock {
  static constexpr std::size_t kSize = 16;
  using Lanes = std::array<float, kSize>;

  Lanes x, y, z;  ///< the hit from the layer's centre, in the map's axes, metres
  /// The area of surface that the ray stands for, cubic metres a metre: its dot product with the
  /// way from an optical centre to the hit is w d^3, w the solid angle seen from there.
  Lanes area_x, area_y, area_z;
  Lanes u_old;
  Lanes farthest_m;  ///< for u_d: range_min_m where the ray started inside the voxel, else endless
};

/// What a sensor brings to the sum.
struct PanoramaModel {
  PanoramaModel(const SensorOptions& sensor, double resolution_m);

  double half_fov_h_rad, half_fov_v_rad;  ///< up to the outer edges of the outer rays' cells
  double ray_spacing_h_rad, ray_spacing_v_rad;
  double density;                             ///< rho: rays per unit of image area
  double weight_distance;                     ///< of u_d in u
  double weight_h_per_rad, weight_v_per_rad;  ///< of |alpha_h|, |alpha_v| in u
  double focal_distance_m;
  double range_min_m;
  double far_gate_m;             ///< the middle of the far gate
  double far_gate_half_width_m;  ///< half a voxel, so that the gate is 1 up to range_max_m
  bool equal_angles;
  bool z_depth;
};

/// Where the sensor is, seen from a layer's centre, and how wide the edges are smoothed.
struct PanoramaView {
  Eigen::Matrix3d R_sensor_map;
  Eigen::Vector3d centre_m;  ///< the optical centre, in the map's axes
  double tau_h_rad;
  double tau_v_rad;
};

/// A sum and how it changes when the sensor moves: with an angular velocity w and a velocity v in
/// the sensor frame it changes at the rate -(w . torque + v . force).
struct PanoramaSum {
  double gain = 0.0;
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Two numbers a hit, block by block.
struct HitTerms {
  std::vector<double> rays;  ///< the expected number of rays on the hit
  std::vector<double> gain;  ///< what one of them gains, Equation (12)

  void resize(std::size_t blocks) {
    rays.resize(blocks * HitBlock::kSize);
    gain.resize(blocks * HitBlock::kSize);
  }
};

/// The sums over the blocks `ids`, computed in single or double precision.
struct PanoramaKernel {
  /// sum of rays * gain.
  double (*gain)(const PanoramaModel&, const PanoramaView&, const HitBlock*,
                 std::span<const std::uint32_t> ids);
  /// The same with its derivatives.
  PanoramaSum (*gain_and_motion)(const PanoramaModel&, const PanoramaView&, const HitBlock*,
                                 std::span<const std::uint32_t> ids);
  /// Each hit's terms.
  void (*terms)(const PanoramaModel&, const PanoramaView&, const HitBlock*,
                std::span<const std::uint32_t> ids, HitTerms& terms);
  /// The derivatives of a function of the terms, given its own by each term. Leaves gain 0.
  PanoramaSum (*motion)(const PanoramaModel&, const PanoramaView&, const HitBlock*,
                        std::span<const std::uint32_t> ids, const HitTerms& by_term);
};

PanoramaKernel panorama_kernel(bool double_precision);

}  // namespace nbvopt::detail
