// A Gaussian process over base poses in the plane.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <span>

namespace nbvopt {

/// Matern's covariance with nu = 3/2, of poses (x, y, yaw) in m, m and rad: sf^2 (1 + r) exp(-r),
/// where r is sqrt(3) times the distance by the length scale.
struct PoseCovariance {
  double signal_variance = 100.0;  ///< sf^2
  double length_scale_m = 3.0;
  bool wraps_yaw = true;  ///< whether yaws that differ by a turn are the same

  double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
};

/// Regression with a mean of 0: C. E. Rasmussen, C. K. I. Williams, "Gaussian processes for machine
/// learning", 2006, Eq. 2.25 and 2.26.
class GaussianProcess {
 public:
  static constexpr double kNoiseVariance = 0.01;

  struct Prediction {
    double mean;
    double variance;  ///< of the function, without noise
  };

  /// Learns one value a pose; there is at least one.
  GaussianProcess(const PoseCovariance& covariance, std::span<const Eigen::Vector3d> poses,
                  const Eigen::VectorXd& values);

  Prediction predict(const Eigen::Vector3d& pose) const;

 private:
  PoseCovariance covariance_;
  Eigen::Matrix3Xd poses_;
  /// Not L L^T: distances on a circle need not make a positive definite matrix.
  Eigen::LDLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd weights_;
};

}  // namespace nbvopt
