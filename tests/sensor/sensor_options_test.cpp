#include "nbvopt/sensor/sensor_options.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kNaN;

using test::message_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(SensorOptions, DefaultIsValid) { EXPECT_NO_THROW(SensorOptions{}.validate()); }

struct BadField {
  const char* field;
  const char* value;
  std::function<void(SensorOptions&)> spoil;
};

class BadSensorOptions : public testing::TestWithParam<BadField> {};

TEST_P(BadSensorOptions, AreNamedWithTheirValueInOneLine) {
  SensorOptions options;
  GetParam().spoil(options);
  const std::string message = message_of<InputError>([&] { options.validate(); });
  EXPECT_THAT(message, AllOf(HasSubstr(std::string("sensor.") + GetParam().field + " is " +
                                       GetParam().value + ", it must be "),
                             Not(HasSubstr("\n"))));
}

INSTANTIATE_TEST_SUITE_P(
    EveryField, BadSensorOptions,
    testing::Values(
        BadField{"half_fov_horizontal_rad", "0", [](auto& s) { s.half_fov_horizontal_rad = 0; }},
        BadField{"half_fov_vertical_rad", "1.6", [](auto& s) { s.half_fov_vertical_rad = 1.6; }},
        BadField{"horizontal_rays", "0", [](auto& s) { s.horizontal_rays = 0; }},
        BadField{"vertical_rays", "-3", [](auto& s) { s.vertical_rays = -3; }},
        BadField{"horizontal_rays", "10000",
                 [](auto& s) { s.horizontal_rays = s.vertical_rays = 10000; }},
        BadField{"horizontal_pixels", "0", [](auto& s) { s.horizontal_pixels = 0; }},
        BadField{"vertical_pixels", "20000", [](auto& s) { s.vertical_pixels = 20000; }},
        BadField{"range_min_m", "-0.1", [](auto& s) { s.range_min_m = -0.1; }},
        BadField{"range_min_m", "4", [](auto& s) { s.range_min_m = 4.0; }},
        BadField{"range_max_m", "nan", [](auto& s) { s.range_max_m = kNaN; }},
        BadField{"range_max_m", "1001", [](auto& s) { s.range_max_m = 1001; }},
        BadField{"focal_distance_m", "-1", [](auto& s) { s.focal_distance_m = -1; }},
        BadField{"uncertainty_half_fov_horizontal_rad", "-1",
                 [](auto& s) { s.uncertainty_half_fov_horizontal_rad = -1; }},
        BadField{"uncertainty_half_fov_vertical_rad", "nan",
                 [](auto& s) { s.uncertainty_half_fov_vertical_rad = kNaN; }},
        BadField{"occupied_uncertainty", "1.5", [](auto& s) { s.occupied_uncertainty = 1.5; }}));

TEST(SensorOptions, EnumeratorsHaveTheNamesOfTheFiles) {
  EXPECT_EQ(to_string(RayPattern::pixel_centres), "pixel_centres");
  EXPECT_EQ(to_string(RayPattern::equal_angles), "equal_angles");
  EXPECT_EQ(to_string(RangeAxis::euclidean), "euclidean");
  EXPECT_EQ(to_string(RangeAxis::z_depth), "z_depth");
  EXPECT_EQ(to_string(UncertaintyMode::distance), "distance");
  EXPECT_EQ(to_string(UncertaintyMode::angle), "angle");
  EXPECT_EQ(to_string(UncertaintyMode::both), "both");
  EXPECT_EQ(to_string(Counting::per_ray), "per_ray");
  EXPECT_EQ(to_string(Counting::per_voxel), "per_voxel");
  EXPECT_EQ(to_string(NoReturn::clear), "clear");
  EXPECT_EQ(to_string(NoReturn::ignore), "ignore");
}

TEST(SensorOptions, ReachesFartherInTheCornersAlongTheOpticalAxis) {
  SensorOptions sensor;
  sensor.half_fov_horizontal_rad = std::atan(0.6);
  sensor.half_fov_vertical_rad = std::atan(0.5);
  sensor.range_max_m = 2.0;
  EXPECT_EQ(sensor.longest_range_m(), 2.0);
  sensor.range_axis = RangeAxis::z_depth;
  EXPECT_NEAR(sensor.longest_range_m(), 2.0 * std::sqrt(1.61), 1e-12);
}

}  // namespace
}  // namespace nbvopt
