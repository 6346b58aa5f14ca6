#include "sim/exploration/volume/gaussian_process.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace nbvopt {
namespace {

struct Expected {
  Eigen::Vector3d pose;
  double mean;
  double variance;
};

const std::vector<Eigen::Vector3d> kPoses{
    {0.0, 0.0, 0.0}, {1.0, 0.5, 3.0}, {-2.0, 1.0, -3.0}, {4.0, -1.0, 0.5}, {0.3, 2.0, 1.5}};

GaussianProcess process(const PoseCovariance& covariance) {
  Eigen::VectorXd values(5);
  values << 2.0, 7.0, 1.5, 12.0, 4.0;
  return {covariance, kPoses, values};
}

void expect(const GaussianProcess& process, const std::vector<Expected>& expected) {
  for (const Expected& at : expected) {
    const GaussianProcess::Prediction prediction = process.predict(at.pose);
    EXPECT_NEAR(prediction.mean, at.mean, 1e-9);
    EXPECT_NEAR(prediction.variance, at.variance, 1e-9);
  }
}

// Means and variances by GaussianProcessRegressor(kernel=100 * Matern(length_scale, nu=1.5),
// alpha=0.01, optimizer=None) of scikit-learn 1.2.1; where yaws wrap, with that kernel on wrapped
// differences. NumPy's k^T (K + 0.01 I)^-1 y and 100 - k^T (K + 0.01 I)^-1 k are the same.
TEST(GaussianProcess, PredictsWhatOthersPredict) {
  expect(process({.length_scale_m = 3.0, .wraps_yaw = true}),
         {{{0.5, 0.5, 0.2}, 3.237660556866938, 9.064409202946052},
          {{1.0, 0.5, -3.1}, 6.853844545795911, 0.9389449793927724},
          {{9.0, 9.0, 0.0}, 0.1589454760854181, 99.97703495855234}});
  expect(process({.length_scale_m = 9.0, .wraps_yaw = false}),
         {{{0.5, 0.5, 0.2}, 3.091458729899269, 0.7539922778876189},
          {{1.0, 0.5, -3.1}, 3.945120161637243, 12.095227173205444},
          {{9.0, 9.0, 0.0}, 5.168405646147243, 81.03321499526467}});
}

TEST(GaussianProcess, IsTheSameAFullTurnOnWhereYawsWrap) {
  const GaussianProcess wrapping = process({.wraps_yaw = true});
  const Eigen::Vector3d turn(0.0, 0.0, 2.0 * std::numbers::pi);
  const Eigen::Vector3d pose(0.7, -0.2, 0.9);
  EXPECT_NEAR(wrapping.predict(pose).mean, wrapping.predict(pose + turn).mean, 1e-9);
  const GaussianProcess plain = process({.wraps_yaw = false});
  EXPECT_GT(plain.predict(pose + turn).variance, plain.predict(pose).variance + 1.0);
}

}  // namespace
}  // namespace nbvopt
