// What the robot of a soak sees, and where it is.
#pragma once

#include <random>

#include "nbvopt/map/scan.hpp"
#include "nbvopt/mast/mast.hpp"

namespace nbvopt::bench {

inline Transform soak_base(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-3.0, 3.0);  // metres, and an angle
  const double x_m = any(random);
  const double y_m = any(random);
  return base_pose(x_m, y_m, 0.0, any(random));
}

inline Transform soak_pose(std::mt19937_64& random) {
  const Mast mast{MastOptions{}};
  return soak_base(random) * mast.T_base_sensor({.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4});
}

/// A wall with holes.
inline Scan soak_scan(std::mt19937_64& random) {
  Scan scan;
  const auto distance_m = std::uniform_real_distribution<float>(1.0F, 4.0F)(random);
  for (int i = -40; i < 40; ++i) {
    for (int j = -30; j < 30; ++j) {
      const Eigen::Vector3f direction(0.013F * static_cast<float>(i),
                                      0.013F * static_cast<float>(j), 1.0F);
      if (random() % 20 == 0) {
        scan.no_returns.push_back(direction);
      } else {
        scan.points_m.push_back(distance_m * direction);
      }
    }
  }
  return scan;
}

/// Nothing in any direction: much to write.
inline Scan soak_sphere(std::mt19937_64& random) {
  std::normal_distribution<float> any;
  Scan scan;
  for (int i = 0; i < 30'000; ++i) {
    scan.no_returns.push_back({any(random), any(random), any(random)});
  }
  return scan;
}

}  // namespace nbvopt::bench
