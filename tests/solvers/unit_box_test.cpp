// The map between a box and the unit box that third-party solvers work in.
#include "solvers/unit_box.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

const Box kBox{Eigen::Vector3d(0.1, 5.0, -0.7), Eigen::Vector3d(0.3, 5.0, 0.1)};

TEST(UnitBox, LeavesFrozenCoordinatesOut) {
  const UnitBox unit_box(kBox, Eigen::Vector3d(0.2, 5.0, 0.0));
  EXPECT_EQ(unit_box.dimension(), 2);
  EXPECT_EQ(unit_box.from_unit(Eigen::Vector2d(0.3, 0.9))[1], 5.0);
}

TEST(UnitBox, MapsZeroAndOneToTheFacesAndClampsBeyond) {
  const UnitBox unit_box(kBox, Eigen::Vector3d(0.2, 5.0, 0.0));
  EXPECT_EQ(unit_box.from_unit(Eigen::Vector2d(0.0, 0.0)), kBox.lower);
  EXPECT_EQ(unit_box.from_unit(Eigen::Vector2d(1.0, 1.0)), kBox.upper);
  EXPECT_EQ(unit_box.from_unit(Eigen::Vector2d(-0.1, 1.1)), Eigen::Vector3d(0.1, 5.0, 0.1));
}

TEST(UnitBox, MapsTheUnitStartToTheStartToTheLastBit) {
  for (int i = 1; i < 1000; ++i) {
    const Point start = Eigen::Vector3d(0.1 + 0.2 * i / 1000.0, 5.0, -0.7 + 0.8 * i / 1000.0);
    const UnitBox unit_box(kBox, start);
    ASSERT_EQ(unit_box.from_unit(unit_box.unit_start()), start) << i;
  }
}

TEST(UnitBox, ScalesDerivativesByTheWidth) {
  const UnitBox unit_box(kBox, Eigen::Vector3d(0.2, 5.0, 0.0));
  const Point gradient = unit_box.unit_gradient(Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_TRUE(gradient.isApprox(Eigen::Vector2d(0.2, 2.4)));
  const Eigen::MatrixXd jacobian =
      unit_box.unit_jacobian((Eigen::MatrixXd(1, 3) << 1.0, 2.0, 3.0).finished());
  EXPECT_TRUE(jacobian.isApprox(Eigen::RowVector2d(0.2, 2.4)));
}

}  // namespace
}  // namespace nbvopt
