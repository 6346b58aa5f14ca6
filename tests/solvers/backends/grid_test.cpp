// Algorithms 1 and 2 of the paper on functions with known lattices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/registry.hpp"
#include "solvers/point.hpp"

namespace nbvopt {
namespace {

using test::point;
using testing::ElementsAre;
using testing::HasSubstr;

/// A function of one to three coordinates that remembers where it was evaluated, in order.
class RecordedFunction final : public Objective {
 public:
  using Function = std::function<double(const Point&)>;

  RecordedFunction(Box box, Function value, Function tie_cost)
      : box_(std::move(box)), value_(std::move(value)), tie_cost_(std::move(tie_cost)) {}

  const Box& box() const override { return box_; }
  double value(const Point& x) const override {
    points_.emplace_back(x.begin(), x.end());
    return value_(x);
  }
  double tie_cost(const Point& x) const override { return tie_cost_(x); }

  const std::vector<std::vector<double>>& points() const { return points_; }

 private:
  Box box_;
  Function value_;
  Function tie_cost_;
  mutable std::vector<std::vector<double>> points_;
};

RecordedFunction flat(Box box) {
  return {std::move(box), [](const Point&) { return 0.0; }, [](const Point&) { return 0.0; }};
}

SolveResult solve_grid(const Objective& objective, const Point& start, std::vector<double> steps,
                       const StopRule& stop = {}) {
  Search options;
  options.grid_steps = std::move(steps);
  SolveRequest request;
  request.start = start;
  request.stop = stop;
  return make_solver("grid", options)->solve(objective, request);
}

TEST(Grid, EvaluatesTheStartThenTheLatticeFromTheLowerEnd) {
  const auto f = flat({point({-1.0, 5.0}), point({1.1, 6.0})});
  const SolveResult result = solve_grid(f, point({0.3, 5.5}), {1.0, 0.5});
  EXPECT_THAT(f.points(), ElementsAre(ElementsAre(0.3, 5.5),                     //
                                      ElementsAre(-1, 5), ElementsAre(-1, 5.5),  //
                                      ElementsAre(-1, 6), ElementsAre(0, 5),     //
                                      ElementsAre(0, 5.5), ElementsAre(0, 6),    //
                                      ElementsAre(1, 5), ElementsAre(1, 5.5),    //
                                      ElementsAre(1, 6)));
  EXPECT_EQ(result.status, SolveStatus::grid_complete);
  EXPECT_EQ(result.evaluations, 10);
}

TEST(Grid, AStepOfZeroFreezesTheCoordinateAtTheStart) {
  const auto f = flat({point({0.0, 0.0}), point({1.0, 1.0})});
  solve_grid(f, point({0.0, 0.7}), {0.5, 0.0});
  EXPECT_THAT(f.points(),
              ElementsAre(ElementsAre(0, 0.7), ElementsAre(0.5, 0.7), ElementsAre(1, 0.7)));
}

TEST(Grid, MeetsTheUpperEndInSpiteOfRounding) {
  const auto f = flat({point({0.0}), point({0.3})});  // 3 * 0.1 > 0.3 in binary
  solve_grid(f, point({0.0}), {0.1});
  ASSERT_EQ(f.points().size(), 4U);
  EXPECT_EQ(f.points().back()[0], 0.3);
}

TEST(Grid, DoesNotAccumulateItsSteps) {
  const auto f = flat({point({0.0}), point({100.0})});
  solve_grid(f, point({0.0}), {0.1});
  ASSERT_EQ(f.points().size(), 1001U);
  EXPECT_EQ(f.points()[777][0], 777 * 0.1);
}

TEST(Grid, TakesTheHighestValue) {
  const RecordedFunction f(
      {point({0.0}), point({1.0})}, [](const Point& x) { return -std::abs(x[0] - 0.6); },
      [](const Point&) { return 0.0; });
  const SolveResult result = solve_grid(f, point({0.1}), {0.25});
  EXPECT_EQ(result.best[0], 0.5);
  EXPECT_DOUBLE_EQ(result.value, -0.1);
}

TEST(Grid, BreaksTiesByCostThenByOrder) {
  const Box box{point({0.0}), point({1.0})};
  const auto plateau = [](const Point& x) { return x[0] > 0.3 ? 1.0 : 0.0; };
  const RecordedFunction nearest(box, plateau, [](const Point& x) { return std::abs(x[0] - 0.8); });
  EXPECT_EQ(solve_grid(nearest, point({0.0}), {0.25}).best[0], 0.75);
  const RecordedFunction indifferent(box, plateau, [](const Point&) { return 0.0; });
  EXPECT_EQ(solve_grid(indifferent, point({0.0}), {0.25}).best[0], 0.5);
}

TEST(Grid, ObeysTheEvaluationLimitExactly) {
  const auto f = flat({point({0.0}), point({1.0})});
  StopRule stop;
  stop.max_evaluations = 4;
  const SolveResult result = solve_grid(f, point({0.0}), {0.1}, stop);
  EXPECT_EQ(f.points().size(), 4U);
  EXPECT_EQ(result.status, SolveStatus::evaluation_limit);
  stop.max_evaluations = 11;  // as many as there are
  EXPECT_EQ(solve_grid(f, point({0.0}), {0.1}, stop).status, SolveStatus::grid_complete);
}

TEST(Grid, RefusesBadStepsByName) {
  const auto f = flat({point({0.0, 0.0}), point({1.0, 1.0})});
  const auto message_of = [&](std::vector<double> steps) -> std::string {
    try {
      solve_grid(f, point({0.0, 0.0}), std::move(steps));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no UsageError";
  };
  EXPECT_THAT(message_of({0.1, -0.5}), HasSubstr("grid_steps[1] = -0.5"));
  EXPECT_THAT(message_of({std::nan(""), 0.1}), HasSubstr("grid_steps[0] = nan"));
  EXPECT_THAT(message_of({std::numeric_limits<double>::infinity(), 0.1}),
              HasSubstr("grid_steps[0] = inf"));
  EXPECT_THAT(message_of({0.1}), HasSubstr("1 given, 2 needed"));
  EXPECT_THAT(message_of({1e-4, 1e-4}), HasSubstr("larger steps"));
  EXPECT_THAT(message_of({1e-300, 1e-300}), HasSubstr("larger steps"));
  EXPECT_TRUE(f.points().empty());
}

}  // namespace
}  // namespace nbvopt
