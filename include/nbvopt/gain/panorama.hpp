// The panorama surrogate: a smooth gain of views with an analytic gradient.
//
// Where the optical centre stays, pan and tilt never change what hides what. So rays are cast once
// from a centre, in all directions that a view in reach could see: a layer. The gain of any pan
// and tilt is then a weighted sum over the hits in view,
//
//   G(q) = sum_k w_k(q) rho / J(X, Y) S((F_h - |alpha_h|) / tau_h) S((F_v - |alpha_v|) / tau_v)
//                S_far(d) relu(u_old - u_new(q)),
//
// with (x, y, z) the hit in the sensor frame, X = x / z, Y = y / z, d its distance, alpha_h and
// alpha_v its angles (Eq. 3, 4), u_new Eq. 8 there, w_k its solid angle, rho / J the density of
// the sensor's rays, F half the field of view, S a C2 step from 0 at -1 to 1 at 1, and relu and the
// absolute values in u_new rounded off within 0.005. Away from the casting centre a hit keeps its
// area, not its solid angle: w_k(q) = w_k (cos theta / cos theta_0) (d_0 / d)^2, theta against the
// face by which the ray entered, or against the ray where it started inside.
//
// Layers lie along the mast (and along the path of a moving base), at most a voxel apart, and are
// blended so that G has a continuous gradient. A layer consists of patches of 4 x 4 rays, which
// are cast when a view first needs them; the values do not depend on what was cast before.
//
// Per ray, G converges to the exact gain of an ever denser sensor as rays and layers become denser
// and tau shrinks with them: the sum is the midpoint rule of the integral over the field of view
// that the sum over rays approximates as well, and S tends to the edge's step. At the sensor's own
// spacing the two differ by the sampling of either. Per voxel, each voxel counts with its best hit,
// times min(1, n), n the expected number of rays on it, and denser layers do not converge.
//
// Where the sensor's gain is expected, rays go on through the unknown. With what probability they
// are hit there, and get to what is behind, does not depend on pan and tilt either: a ray leaves up
// to three hits, weighted by it, two that stand for all in the unknown (Gauss quadrature), and its
// end.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

struct PanoramaOptions {
  double ray_spacing = 1.0;       ///< of the layers' rays, in spacings of the sensor's
  double layer_spacing = 1.0;     ///< in voxels, or half voxels where they are 0.1 m or larger
  double smoothing = 1.0;         ///< the widest tau, in spacings of the layers' rays
  bool double_precision = false;  ///< the sums; single precision is good to 1e-6

  bool operator==(const PanoramaOptions&) const = default;

  /// Throws InputError that names the first bad field.
  void validate() const;
};

/// The smooth gain over joint positions. Thread-safe; what it casts is kept.
class Panorama {
 public:
  /// Over joint positions in `box`. The grid's voxels in reach must be ready or lazily filled.
  /// Throws InputError when the sensor's or the mast's options cannot be used.
  /// `hazards` are looked at where the sensor's gain is expected.
  Panorama(std::shared_ptr<const VoxelGrid> grid, const SensorOptions& sensor,
           const MovingMast& mast, const JointBox& box, const PanoramaOptions& options = {},
           const HazardTable& hazards = HazardTable());
  ~Panorama();

  /// G(q). `smoothing` in (0, 1] is the share of the widest tau: shrink it to anneal. Throws
  /// UsageError when it lies beyond, and InputError when q leads off the lattice.
  double gain(const JointPosition& q, double smoothing = 1.0) const;

  /// G(q) and its gradient with respect to (pan, tilt, height).
  double gain(const JointPosition& q, Eigen::Vector3d& gradient, double smoothing = 1.0) const;

  /// How many patches of rays there are a layer: the length of patch_gains().
  Eigen::Index patch_count() const;

  /// The share of each patch in G(q), and its derivatives unless null (a row a patch, a column a
  /// joint). Per ray only: throws UsageError otherwise.
  void patch_gains(const JointPosition& q, Eigen::VectorXd& gains,
                   Eigen::MatrixXd* derivatives) const;

  /// More than a patch gains, unless a hit is centimetres from a view that is far off its layer.
  double patch_gain_bound() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nbvopt
