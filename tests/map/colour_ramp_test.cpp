#include "nbvopt/map/colour_ramp.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

TEST(UncertaintyColour, RunsFromGreenOverYellowToRed) {
  EXPECT_EQ(uncertainty_colour(0.0), (Rgb{0, 255, 0}));
  EXPECT_EQ(uncertainty_colour(0.25), (Rgb{128, 255, 0}));
  EXPECT_EQ(uncertainty_colour(0.5), (Rgb{255, 255, 0}));
  EXPECT_EQ(uncertainty_colour(0.75), (Rgb{255, 128, 0}));
  EXPECT_EQ(uncertainty_colour(1.0), (Rgb{255, 0, 0}));
}

TEST(UncertaintyColour, IsClamped) {
  EXPECT_EQ(uncertainty_colour(-3.0), uncertainty_colour(0.0));
  EXPECT_EQ(uncertainty_colour(7.0), uncertainty_colour(1.0));
}

}  // namespace
}  // namespace nbvopt
