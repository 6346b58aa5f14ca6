// What Solver::solve refuses before a solver runs.
#include "nbvopt/solver/solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nbvopt/core/error.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kNaN;
using testing::HasSubstr;

class Flat final : public Objective {
 public:
  explicit Flat(Box box) : box_(std::move(box)) {}
  const Box& box() const override { return box_; }
  double value(const Point&) const override { return 0.0; }

 private:
  Box box_;
};

/// Says that it ran, so that a test sees that nothing was checked away.
class NamedSolver final : public Solver {
 public:
  explicit NamedSolver(SolverNeeds needs) : needs_(needs) {}
  std::string name() const override { return "named"; }
  SolverNeeds needs() const override { return needs_; }

 private:
  SolveResult do_solve(const Objective&, const SolveRequest& request) const override {
    return {SolveStatus::converged, "ran", request.start, 0.0, 1};
  }

  SolverNeeds needs_;
};

Point point(double x, double y) { return Eigen::Vector2d(x, y); }

std::string refusal(const Box& box, const SolveRequest& request, SolverNeeds needs = {}) {
  try {
    return NamedSolver(needs).solve(Flat(box), request).message;
  } catch (const UsageError& error) {
    return error.what();
  }
}

SolveRequest request_from(const Point& start) {
  SolveRequest request;
  request.start = start;
  return request;
}

const Box kUnit{point(0, 0), point(1, 1)};

TEST(Solver, RunsFromAnyPointOfTheBoxItsFacesIncluded) {
  EXPECT_EQ(refusal(kUnit, request_from(point(0.5, 0.5))), "ran");
  EXPECT_EQ(refusal(kUnit, request_from(point(1, 0))), "ran");
}

TEST(Solver, RefusesAStartOutsideTheBoxToTheLastBit) {
  EXPECT_THAT(refusal(kUnit, request_from(point(0.5, std::nextafter(1.0, 2.0)))),
              HasSubstr("start[1]"));
  EXPECT_THAT(refusal(kUnit, request_from(point(kNaN, 0.5))), HasSubstr("start[0]"));
  EXPECT_THAT(refusal(kUnit, request_from(Point::Zero(3))), HasSubstr("3 coordinates"));
}

TEST(Solver, RefusesBoundsThatAreCrossedOrNotFinite) {
  const SolveRequest request = request_from(point(0.5, 0.5));
  EXPECT_THAT(refusal({point(0, 0.6), point(1, 0.4)}, request), HasSubstr("lower[1]"));
  EXPECT_THAT(refusal({point(kNaN, 0), point(1, 1)}, request), HasSubstr("lower[0]"));
  EXPECT_THAT(refusal({point(0, 0), point(1, std::numeric_limits<double>::infinity())}, request),
              HasSubstr("upper[1]"));
  EXPECT_THAT(refusal({point(0, 0), Point::Ones(3)}, request), HasSubstr("box"));
}

TEST(Solver, RefusesALimitThatLeavesNoEvaluation) {
  SolveRequest request = request_from(point(0, 0));
  request.stop.max_evaluations = 0;
  EXPECT_THAT(refusal(kUnit, request), HasSubstr("max_evaluations = 0"));
}

TEST(Solver, RefusesAnObjectiveThatLacksWhatItNeeds) {
  const SolveRequest request = request_from(point(0, 0));
  EXPECT_THAT(refusal(kUnit, request, {.gradient = true}), HasSubstr("gradient"));
  EXPECT_THAT(refusal(kUnit, request, {.residuals = true}), HasSubstr("residuals"));
  EXPECT_THAT(refusal(kUnit, request, {.surrogate = true}), HasSubstr("surrogate"));
}

}  // namespace
}  // namespace nbvopt
