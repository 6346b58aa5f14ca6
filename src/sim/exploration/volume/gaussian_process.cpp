#include "sim/exploration/volume/gaussian_process.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

double PoseCovariance::operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  Eigen::Vector3d difference = a - b;
  if (wraps_yaw) difference.z() = wrap_angle(difference.z());
  const double r = std::numbers::sqrt3 * difference.norm() / length_scale_m;
  return signal_variance * (1.0 + r) * std::exp(-r);
}

GaussianProcess::GaussianProcess(const PoseCovariance& covariance,
                                 std::span<const Eigen::Vector3d> poses,
                                 const Eigen::VectorXd& values)
    : covariance_(covariance), poses_(3, static_cast<Eigen::Index>(poses.size())) {
  for (Eigen::Index i = 0; i < poses_.cols(); ++i) {
    poses_.col(i) = poses[static_cast<std::size_t>(i)];
  }
  Eigen::MatrixXd K(poses_.cols(), poses_.cols());
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    for (Eigen::Index j = 0; j < K.cols(); ++j) K(i, j) = covariance_(poses_.col(i), poses_.col(j));
    K(i, i) += kNoiseVariance;
  }
  factor_.compute(K);
  weights_ = factor_.solve(values);
}

GaussianProcess::Prediction GaussianProcess::predict(const Eigen::Vector3d& pose) const {
  Eigen::VectorXd k(poses_.cols());
  for (Eigen::Index i = 0; i < k.size(); ++i) k[i] = covariance_(poses_.col(i), pose);
  return {k.dot(weights_), covariance_.signal_variance - k.dot(factor_.solve(k))};
}

}  // namespace nbvopt
