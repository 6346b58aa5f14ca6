// Equations (1) to (8) against numbers worked out by hand.
#include "nbvopt/sensor/uncertainty_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nbvopt {
namespace {

/// Half angles that divide well.
SensorOptions round_sensor() {
  SensorOptions sensor;
  sensor.half_fov_horizontal_rad = 0.5;
  sensor.half_fov_vertical_rad = 0.4;
  return sensor;
}

/// A point at these angles and this depth.
Eigen::Vector3d point_at(double alpha_h_rad, double alpha_v_rad, double z_m) {
  return {std::tan(alpha_h_rad) * z_m, std::tan(alpha_v_rad) * z_m, z_m};
}

/// Equation (2): 1 - 2 / (1 + exp(|d - 1|)).
TEST(UncertaintyModel, GrowsWithTheDistanceFromTheFocus) {
  const UncertaintyModel model(round_sensor());
  EXPECT_EQ(model.distance_uncertainty(1.0), 0.0);
  EXPECT_NEAR(model.distance_uncertainty(0.5), 0.2449186624037092, 1e-15);
  EXPECT_NEAR(model.distance_uncertainty(1.5), 0.2449186624037092, 1e-15);
  EXPECT_NEAR(model.distance_uncertainty(2.0), 0.4621171572600098, 1e-15);
  EXPECT_NEAR(model.distance_uncertainty(4.0), 0.9051482536448664, 1e-15);
  EXPECT_NEAR(model.distance_uncertainty(3000.0), 1.0, 1e-15) << "and does not overflow";
}

TEST(UncertaintyModel, CountsDistanceFromItsOwnFocus) {
  SensorOptions sensor = round_sensor();
  sensor.focal_distance_m = 2.5;
  const UncertaintyModel model(sensor);
  EXPECT_EQ(model.distance_uncertainty(2.5), 0.0);
  EXPECT_NEAR(model.distance_uncertainty(3.0), 0.2449186624037092, 1e-15);
}

/// Equations (3) to (7).
TEST(UncertaintyModel, GrowsWithTheAngleFromTheAxis) {
  const UncertaintyModel model(round_sensor());
  EXPECT_EQ(model.angle_uncertainty({0.0, 0.0, 3.0}), 0.0);
  EXPECT_NEAR(model.angle_uncertainty(point_at(0.25, 0.0, 1.0)), 0.25, 1e-15);
  EXPECT_NEAR(model.angle_uncertainty(point_at(0.0, -0.1, 2.0)), 0.125, 1e-15);
  EXPECT_NEAR(model.angle_uncertainty(point_at(-0.4, 0.3, 0.7)), 0.775, 1e-15);
  EXPECT_NEAR(model.angle_uncertainty(point_at(0.5, 0.4, 1.0)), 1.0, 1e-15);
}

TEST(UncertaintyModel, IsNeverMoreThanOneBeyondTheEdge) {
  const UncertaintyModel model(round_sensor());
  EXPECT_EQ(model.angle_uncertainty(point_at(0.6, 0.5, 1.0)), 1.0);
  EXPECT_EQ(model.angle_uncertainty(point_at(0.6, 0.0, 1.0)), 0.5);
  EXPECT_LT(model.uncertainty(point_at(0.6, 0.5, 4.0)), 1.0);
}

TEST(UncertaintyModel, DividesByTheHalfAnglesThatAreGiven) {
  SensorOptions sensor = round_sensor();
  sensor.uncertainty_half_fov_horizontal_rad = 1.0;
  EXPECT_NEAR(UncertaintyModel(sensor).angle_uncertainty(point_at(0.25, 0.1, 1.0)), 0.25, 1e-15);
  sensor.uncertainty_half_fov_vertical_rad = 0.2;
  EXPECT_NEAR(UncertaintyModel(sensor).angle_uncertainty(point_at(0.25, 0.1, 1.0)), 0.375, 1e-15);
}

/// Equation (8), and its halves alone.
TEST(UncertaintyModel, TakesDistanceAngleOrBoth) {
  SensorOptions sensor = round_sensor();
  const Eigen::Vector3d p_sensor_m = 2.0 * point_at(0.25, -0.1, 1.0).normalized();
  EXPECT_NEAR(UncertaintyModel(sensor).uncertainty(p_sensor_m), (0.4621171572600098 + 0.375) / 2.0,
              1e-15);
  sensor.uncertainty_mode = UncertaintyMode::distance;
  EXPECT_NEAR(UncertaintyModel(sensor).uncertainty(p_sensor_m), 0.4621171572600098, 1e-15);
  sensor.uncertainty_mode = UncertaintyMode::angle;
  EXPECT_NEAR(UncertaintyModel(sensor).uncertainty(p_sensor_m), 0.375, 1e-15);
}

TEST(UncertaintyModel, IsLinearInBothWithItsWeights) {
  for (const UncertaintyMode mode :
       {UncertaintyMode::distance, UncertaintyMode::angle, UncertaintyMode::both}) {
    SensorOptions sensor = round_sensor();
    sensor.uncertainty_mode = mode;
    const UncertaintyModel model(sensor);
    const Eigen::Vector3d p_sensor_m(0.3, 0.2, 1.7);
    EXPECT_DOUBLE_EQ(model.distance_weight() * model.distance_uncertainty(p_sensor_m.norm()) +
                         model.angle_weight() * model.angle_uncertainty(p_sensor_m),
                     model.uncertainty(p_sensor_m));
    EXPECT_EQ(model.distance_weight() + model.angle_weight(), 1.0);
  }
}

}  // namespace
}  // namespace nbvopt
