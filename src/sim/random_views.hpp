// Views drawn at random.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "nbvopt/mast/mast.hpp"

namespace nbvopt {

/// Draws views in a box of joints, each as likely as another; the same seed draws the same.
class RandomViews {
 public:
  RandomViews(const JointBox& box, std::uint64_t seed) : box_(box) {
    std::seed_seq seeds{seed, seed >> 32};
    random_.seed(seeds);
  }

  JointPosition next() {
    Eigen::Vector3d q;
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      q[i] =
          box_.min[i] + std::generate_canonical<double, 53>(random_) * (box_.max[i] - box_.min[i]);
    }
    return JointPosition::from(q.cwiseMax(box_.min).cwiseMin(box_.max));
  }

 private:
  JointBox box_;
  std::mt19937_64 random_;
};

}  // namespace nbvopt
