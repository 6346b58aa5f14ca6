// The parts that a strategy is made of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nbvopt/core/error.hpp"
#include "solvers/point.hpp"
#include "solvers/strategy/objectives.hpp"
#include "solvers/strategy/points.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kNaN;
using test::kPi;
using test::point;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// The first coordinate's value; the first coordinate may turn. Counts its evaluations.
class FirstCoordinate final : public Objective {
 public:
  explicit FirstCoordinate(Box box, double period = 0.0) : box_(std::move(box)), period_(period) {}

  const Box& box() const override { return box_; }
  double period(Eigen::Index i) const override { return i == 0 ? period_ : 0.0; }
  double value(const Point& x) const override {
    EXPECT_TRUE(box_.contains(x)) << x.transpose();
    ++evaluations;
    return x[0];
  }
  bool has_gradient() const override { return true; }
  double value_and_gradient(const Point& x, Point& gradient) const override {
    gradient = Point::Unit(x.size(), 0);
    return value(x);
  }

  mutable int evaluations = 0;

 private:
  Box box_;
  double period_;
};

std::vector<std::vector<double>> lists(const std::vector<Point>& points) {
  std::vector<std::vector<double>> result;
  for (const Point& x : points) result.emplace_back(x.begin(), x.end());
  return result;
}

TEST(StartPoints, AreTheLatticeOfThreeAndPointsInsideItsLinesAlongTheFirstCoordinate) {
  const FirstCoordinate f({point({0, 10}), point({6, 20})});
  EXPECT_THAT(lists(start_points(f, 2)),
              UnorderedElementsAre(ElementsAre(0, 10), ElementsAre(3, 10), ElementsAre(6, 10),
                                   ElementsAre(0, 15), ElementsAre(3, 15), ElementsAre(6, 15),
                                   ElementsAre(0, 20), ElementsAre(3, 20), ElementsAre(6, 20),
                                   ElementsAre(2, 10), ElementsAre(4, 10), ElementsAre(2, 15),
                                   ElementsAre(4, 15), ElementsAre(2, 20), ElementsAre(4, 20)));
}

TEST(StartPoints, AreNineLinesInThreeCoordinates) {
  const FirstCoordinate f({point({0, 0, 0}), point({1, 2, 3})});
  EXPECT_EQ(start_points(f, 12).size(), 9U * (3U + 12U));
}

TEST(StartPoints, HaveNoPointTwice) {
  const FirstCoordinate f({point({0, 1, 0}), point({1, 1, 1})}, 1.0);
  for (const int line_points : {0, 1, 2, 3, 12}) {
    std::vector<std::vector<double>> points = lists(start_points(f, line_points));
    std::sort(points.begin(), points.end());
    EXPECT_EQ(std::adjacent_find(points.begin(), points.end()), points.end());
    for (const std::vector<double>& x : points) {
      EXPECT_LT(x[0], 1.0) << "the upper end of a coordinate that turns is the lower one";
      EXPECT_EQ(x[1], 1.0);
    }
  }
}

TEST(StartPoints, LeaveTheLinesOutWhereTheFirstCoordinateIsFrozen) {
  const FirstCoordinate f({point({2, 0}), point({2, 1})});
  EXPECT_THAT(lists(start_points(f, 12)),
              UnorderedElementsAre(ElementsAre(2, 0), ElementsAre(2, 0.5), ElementsAre(2, 1)));
}

TEST(StartPoints, RefuseMoreCornersThanCanBeSampled) {
  const FirstCoordinate f({Point::Zero(9), Point::Ones(9)});
  EXPECT_THROW(start_points(f, 0), UsageError);
}

TEST(SeparatePoints, SkipPointsNearABetterOneInSharesOfTheBox) {
  const FirstCoordinate f({point({0, 0}), point({1, 10})});
  const Eigen::MatrixXd points =
      (Eigen::MatrixXd(2, 5) << 0.5, 0.55, 0.55, 0.7, 0.5, 5, 5.5, 7, 5, 5).finished();
  const std::vector<double> values{4, 5, 3, 2, kNaN};
  EXPECT_THAT(separate_points(f, points, values, 0.1, 9), ElementsAre(1, 2, 3));
  EXPECT_THAT(separate_points(f, points, values, 0.1, 2), ElementsAre(1, 2));
  EXPECT_THAT(separate_points(f, points, values, 0.0, 9), ElementsAre(1, 0, 2, 3));
}

TEST(SeparatePoints, MeasureTheShortWayRound) {
  const Box box{point({0}), point({1})};
  const Eigen::MatrixXd points = (Eigen::MatrixXd(1, 2) << 0.02, 0.98).finished();
  EXPECT_THAT(separate_points(FirstCoordinate(box, 1.0), points, std::vector{1.0, 2.0}, 0.1, 9),
              ElementsAre(1));
  EXPECT_THAT(separate_points(FirstCoordinate(box), points, std::vector{1.0, 2.0}, 0.1, 9),
              ElementsAre(1, 0));
}

TEST(SeparatePoints, IgnoreFrozenCoordinatesAndKeepTheOrderOfTies) {
  const FirstCoordinate f({point({0, 3}), point({1, 3})});
  const Eigen::MatrixXd points = (Eigen::MatrixXd(2, 3) << 0.1, 0.5, 0.9, 3, 3, 3).finished();
  EXPECT_THAT(separate_points(f, points, std::vector{1.0, 1.0, 1.0}, 0.1, 9), ElementsAre(0, 1, 2));
}

TEST(ShiftedPeriod, HasItsCentreInTheMiddleAndEvaluatesInTheOwnBox) {
  const FirstCoordinate f({point({-kPi, 0}), point({kPi, 1})}, 2.0 * kPi);
  for (int i = 0; i <= 1000; ++i) {
    const Point centre = point({std::lerp(-kPi, kPi, i / 1000.0), 0.3});
    const ShiftedPeriod shifted(f, centre);
    EXPECT_EQ(shifted.wrapped(centre), centre);
    EXPECT_NEAR(shifted.box().upper[0] - centre[0], kPi, 1e-15);
    EXPECT_EQ(shifted.box().upper[1], 1.0);
    for (const Point& end : {shifted.box().lower, shifted.box().upper}) {
      const double value = shifted.value(end);  // in the own box: f itself looks
      EXPECT_NEAR(std::remainder(value - end[0], 2.0 * kPi), 0.0, 1e-14);
    }
  }
}

TEST(ShiftedPeriod, StaysInTheOwnBoxToTheLastBit) {
  for (int i = 0; i < 1000; ++i) {
    const double lower = 0.003 * i;
    const double upper = lower + 2.0 * kPi * (1.0 - 1e-15);  // a few last bits short of a period
    const FirstCoordinate f({point({lower}), point({upper})}, 2.0 * kPi);
    const ShiftedPeriod shifted(f, point({lower}));
    for (const double x : {std::nextafter(lower, -10.0), std::nextafter(upper, 30.0)}) {
      EXPECT_TRUE(f.box().contains(shifted.wrapped(point({x})))) << i;
    }
  }
}

TEST(ShiftedPeriod, LeavesOtherCoordinatesAndBatchesAsTheyAre) {
  const FirstCoordinate f({point({0}), point({1})}, 1.0);
  const ShiftedPeriod shifted(f, point({0.25}));
  std::vector<double> values(2);
  shifted.values(std::vector<Point>{point({-0.25}), point({0.5})}, values);
  EXPECT_THAT(values, ElementsAre(0.75, 0.5));
}

TEST(RecordingObjective, RemembersEveryPointOnce) {
  const FirstCoordinate f({point({0, 0}), point({1, 1})});
  const RecordingObjective recording(f);
  std::vector<double> values(2);
  recording.values(std::vector<Point>{point({0.1, 0}), point({0.2, 0})}, values);
  EXPECT_EQ(recording.value(point({0.2, 0})), 0.2);  // known
  EXPECT_EQ(recording.value(point({0.2, 0.5})), 0.2);
  Point gradient;
  EXPECT_EQ(recording.value_and_gradient(point({0.3, 0}), gradient), 0.3);
  EXPECT_EQ(gradient, point({1, 0}));
  EXPECT_EQ(f.evaluations, 4);
  EXPECT_EQ(recording.evaluations(), 4);
  EXPECT_THAT(recording.values(), ElementsAre(0.1, 0.2, 0.2, 0.3));
  EXPECT_EQ(recording.points().col(2), point({0.2, 0.5}));
}

}  // namespace
}  // namespace nbvopt
