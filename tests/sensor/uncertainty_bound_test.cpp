#include "sensor/uncertainty_bound.hpp"

#include <gtest/gtest.h>

#include <random>

namespace nbvopt {
namespace {

float bound(const UncertaintyModel& model, const Eigen::Vector3f& p) {
  using One = Eigen::Array<float, 1, 1>;
  return UncertaintyBound(model)(One(p.x()), One(p.y()), One(p.z()))[0];
}

/// Cameras of every mode, from telephoto to fisheye.
std::vector<UncertaintyModel> models() {
  std::vector<UncertaintyModel> models;
  for (const auto mode :
       {UncertaintyMode::distance, UncertaintyMode::angle, UncertaintyMode::both}) {
    for (const double half_fov_rad : {0.01, 0.5, 1.5}) {
      for (const double focal_distance_m : {0.1, 1.0, 60.0}) {
        SensorOptions sensor;
        sensor.uncertainty_mode = mode;
        sensor.half_fov_horizontal_rad = half_fov_rad;
        sensor.half_fov_vertical_rad = 0.7 * half_fov_rad;
        sensor.focal_distance_m = focal_distance_m;
        models.emplace_back(sensor);
      }
    }
  }
  return models;
}

TEST(UncertaintyBound, IsNeverAboveTheUncertainty) {
  std::mt19937 random(5);
  std::normal_distribution<float> coordinate_m(0.0F, 1.0F);
  for (const UncertaintyModel& model : models()) {
    for (int i = 0; i < 4000; ++i) {
      Eigen::Vector3f p(coordinate_m(random), coordinate_m(random), coordinate_m(random));
      if (i % 2 == 0) p.z() = std::abs(p.z()) * 20.0F;
      if (i % 7 == 0) p.x() = 0.0F;
      if (i % 11 == 0) p.z() = 0.0F;
      EXPECT_LE(bound(model, p), model.uncertainty(p.cast<double>())) << p.transpose();
    }
  }
}

TEST(UncertaintyBound, IsNearItInFrontOfTheCamera) {
  const UncertaintyModel model{SensorOptions{}};
  for (float x = -1.0F; x <= 1.0F; x += 0.05F) {
    for (float z = 0.1F; z < 6.0F; z += 0.1F) {
      const Eigen::Vector3f p(x, 0.5F * x, z);
      EXPECT_NEAR(bound(model, p), model.uncertainty(p.cast<double>()), 2e-4) << p.transpose();
    }
  }
}

}  // namespace
}  // namespace nbvopt
