// Strategies on functions whose global optima are known.
#include "nbvopt/solver/strategy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "contract/solver_contract_problem.hpp"
#include "nbvopt/core/error.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kPi;
using testing::AllOf;
using testing::HasSubstr;
using testing_contract::quadratic;
using testing_contract::rastrigin;
using testing_contract::Record;
using testing_contract::Textbook;
using testing_contract::TextbookProblem;

constexpr double kTop = TextbookProblem::kTop;

/// Local optima 1 apart along the first coordinate; the global one at (1.3, 5), on a face, and
/// worth kTop - 1.
Textbook rastrigin_on_a_face() {
  const auto residuals = [](const Point& x, Eigen::VectorXd& r, Eigen::MatrixXd& jacobian) {
    const double y = x[0] - 1.3;
    const double amplitude = std::sqrt(20.0);
    r = Eigen::Vector3d(y, amplitude * std::sin(kPi * y), x[1] - 6.0);
    jacobian.setZero(3, 2);
    jacobian(0, 0) = 1.0;
    jacobian(1, 0) = amplitude * kPi * std::cos(kPi * y);
    jacobian(2, 1) = 1.0;
  };
  return {.box = {Eigen::Vector2d(-4, -4), Eigen::Vector2d(5, 5)},
          .residual_count = 3,
          .residuals = residuals};
}

/// The first coordinate turns; the squared distance on the circle from `optimum_rad`, with
/// `ripples` local optima of the given height.
Textbook circle(double optimum_rad, double ripples, double height) {
  const auto residuals = [=](const Point& x, Eigen::VectorXd& r, Eigen::MatrixXd& jacobian) {
    r.resize(5);
    jacobian.setZero(5, 2);
    const auto chord = [&](Eigen::Index row, double turns, double amplitude) {
      r[row] = amplitude * (std::cos(turns * x[0]) - std::cos(turns * optimum_rad));
      r[row + 1] = amplitude * (std::sin(turns * x[0]) - std::sin(turns * optimum_rad));
      jacobian(row, 0) = -amplitude * turns * std::sin(turns * x[0]);
      jacobian(row + 1, 0) = amplitude * turns * std::cos(turns * x[0]);
    };
    chord(0, 1.0, 1.0);
    chord(2, ripples, 0.5 * std::sqrt(height));
    r[4] = x[1] - 0.2;
    jacobian(4, 1) = 1.0;
  };
  return {.box = {Eigen::Vector2d(-kPi, -1), Eigen::Vector2d(kPi, 1)},
          .residual_count = 5,
          .residuals = residuals,
          .periodic_coordinate = 0};
}

SolveRequest request_from(const Point& start) {
  SolveRequest request;
  request.start = start;
  return request;
}

SolveResult solve(const Objective& objective, const SolveRequest& request,
                  const StrategyOptions& options = {}) {
  return make_strategy(options)->solve(objective, request);
}

bool has_evaluated(const TextbookProblem& problem, const Point& x) {
  return std::any_of(problem.records().begin(), problem.records().end(),
                     [&](const Record& record) { return record.x == x; });
}

double best_value(const std::vector<Record>& records) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Record& record : records) best = std::max(best, record.value);
  return best;
}

std::string refusal(const StrategyOptions& options) {
  try {
    make_strategy(options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no UsageError";
}

TEST(Strategy, FindsTheGlobalOptimumOnAFace) {
  const TextbookProblem problem(rastrigin_on_a_face());
  const SolveResult result = solve(problem, request_from(Eigen::Vector2d(-3.2, 0.1)));
  EXPECT_NEAR(result.value, kTop - 1.0, 1e-3);
  EXPECT_NEAR(result.best[0], 1.3, 0.01);
  EXPECT_EQ(result.best[1], 5.0);
  EXPECT_EQ(result.status, SolveStatus::converged) << result.message;
}

TEST(Strategy, FindsTheGlobalOptimumInside) {
  const TextbookProblem problem = rastrigin();
  const SolveResult result = solve(problem, request_from(Eigen::Vector2d(-3.4, 3.9)));
  EXPECT_NEAR(result.value, kTop, 0.01);
}

TEST(Strategy, FindsAnOptimumAtTheVerySeamFromItsOtherSide) {
  for (const double optimum_rad : {-kPi, kPi, kPi - 0.01, -kPi + 0.01}) {
    for (const double start_rad : {-kPi + 0.3, kPi - 0.3, 0.0}) {
      const TextbookProblem problem(circle(optimum_rad, 7.0, 1.0));
      const SolveResult result = solve(problem, request_from(Eigen::Vector2d(start_rad, 0.9)));
      EXPECT_NEAR(result.value, kTop, 1e-3);
      EXPECT_TRUE(problem.box().contains(result.best));
    }
  }
}

TEST(Strategy, ClimbsAcrossTheSeam) {
  const TextbookProblem problem(circle(kPi - 0.5, 1.0, 0.0));
  StrategyOptions options;
  options.global.clear();
  options.polish.clear();
  options.line_points = 0;
  options.local_starts = 1;  // the sample at -pi
  EXPECT_NEAR(solve(problem, request_from(Eigen::Vector2d(0, 0)), options).value, kTop, 0.01);
}

TEST(Strategy, PolishesAcrossTheSeam) {
  const TextbookProblem problem(circle(-kPi + 0.1, 1.0, 0.0));
  StrategyOptions options;
  options.global.clear();
  options.local.clear();
  const SolveResult result = solve(problem, request_from(Eigen::Vector2d(kPi - 0.2, 0)), options);
  EXPECT_NEAR(result.value, kTop, 1e-3);
}

TEST(Strategy, SearchesOnTheSurrogateAndPolishesOnTheObjective) {
  const TextbookProblem problem(rastrigin_on_a_face());
  const std::vector<Record>& of_surrogate = problem.surrogate()->records();
  const SolveResult result = solve(problem, request_from(Eigen::Vector2d(-3.2, 0.1)));
  // 3^2 points and, the middle left out, 6 more on each of three lines.
  EXPECT_GE(of_surrogate.size(), 27U + 5U);
  EXPECT_LE(of_surrogate.size(), 27U + 20U + 5U * 60U);
  EXPECT_GT(problem.records().size(), 3U);
  EXPECT_LE(problem.records().size(), 1U + 2U + 60U);
  EXPECT_EQ(result.evaluations, static_cast<std::int64_t>(problem.records().size()));
  EXPECT_EQ(result.surrogate_evaluations, static_cast<std::int64_t>(of_surrogate.size()));
  EXPECT_THAT(result.message,
              AllOf(HasSubstr("51 samples"), HasSubstr("of global nlopt:direct-l"),
                    HasSubstr("of local nlopt:lbfgs from 12 starts"), HasSubstr("nlopt:cobyla")));
}

void expect_no_point_twice(const std::vector<Record>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(records[i].x, records[j].x) << i << " " << j;
  }
}

TEST(Strategy, EvaluatesNoPointTwice) {
  for (const Point& start : {Point(Eigen::Vector2d(-3.2, 0.1)), Point(Eigen::Vector2d(5, -4))}) {
    const TextbookProblem problem(rastrigin_on_a_face());
    StrategyOptions options;
    options.local.clear();  // it asks for the gradients at points whose values are known
    solve(problem, request_from(start), options);
    expect_no_point_twice(problem.records());
    expect_no_point_twice(problem.surrogate()->records());
  }
}

TEST(Strategy, AsksNoSurrogateWhereNothingCanMove) {
  Textbook textbook = rastrigin_on_a_face();
  textbook.box.upper = textbook.box.lower;
  const TextbookProblem problem(textbook);
  const SolveResult result = solve(problem, request_from(textbook.box.lower));
  EXPECT_EQ(result.status, SolveStatus::converged);
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.surrogate_evaluations, 0);
}

TEST(Strategy, LeavesStagesOut) {
  for (int stages = 1; stages < 8; ++stages) {
    SCOPED_TRACE(stages);
    StrategyOptions options;
    options.polish_evaluations = 200;  // enough on its own
    if ((stages & 1) == 0) options.global.clear();
    if ((stages & 2) == 0) options.local.clear();
    if ((stages & 4) == 0) options.polish.clear();
    const TextbookProblem problem(rastrigin_on_a_face());
    const SolveRequest request = request_from(Eigen::Vector2d(1.1, 4.0));
    const SolveResult result = solve(problem, request, options);
    EXPECT_EQ(result.value, best_value(problem.records()));
    EXPECT_GT(result.value, kTop - 6.0);
    EXPECT_EQ(result.message.find("nlopt:direct-l") != std::string::npos, (stages & 1) != 0);
    EXPECT_EQ(result.message.find("nlopt:lbfgs") != std::string::npos, (stages & 2) != 0);
    EXPECT_EQ(result.message.find("nlopt:cobyla") != std::string::npos, (stages & 4) != 0);
    const bool is_global_alone = stages == 1;  // which ends by its evaluations
    EXPECT_EQ(result.status,
              is_global_alone ? SolveStatus::evaluation_limit : SolveStatus::converged)
        << result.message;
  }
}

TEST(Strategy, NeedsNoSurrogateToPolishAlone) {
  StrategyOptions options;
  options.global.clear();
  options.polish = "nlopt:sbplx";
  options.local.clear();
  Textbook textbook = rastrigin_on_a_face();
  textbook.has_surrogate = false;
  const TextbookProblem lone(textbook);
  EXPECT_GT(solve(lone, request_from(Eigen::Vector2d(1.1, 4.0)), options).value, kTop - 1.01);
  textbook.has_surrogate = true;
  const TextbookProblem problem(textbook);
  EXPECT_EQ(solve(problem, request_from(Eigen::Vector2d(1.1, 4.0)), options).surrogate_evaluations,
            0);
  EXPECT_THROW(solve(lone, request_from(Eigen::Vector2d(1.1, 4.0))), UsageError);
}

TEST(Strategy, RunsAnyLocalSolver) {
  for (const char* local : {"nlopt:bobyqa", "nlopt:slsqp", "ceres:lm", "ceres:lbfgs"}) {
    StrategyOptions options;
    options.local = local;
    const TextbookProblem problem(rastrigin_on_a_face());
    const SolveResult result = solve(problem, request_from(Eigen::Vector2d(-3.2, 0.1)), options);
    EXPECT_NEAR(result.value, kTop - 1.0, 0.01) << local;
  }
}

TEST(Strategy, SaysThatAStageWasCutShort) {
  StrategyOptions short_local;
  short_local.local_evaluations = 2;
  StrategyOptions short_polish;
  short_polish.polish_evaluations = 5;
  for (const StrategyOptions& options : {short_local, short_polish}) {
    const TextbookProblem problem(rastrigin_on_a_face());
    const SolveResult result = solve(problem, request_from(Eigen::Vector2d(-3.2, 0.1)), options);
    EXPECT_EQ(result.status, SolveStatus::evaluation_limit) << result.message;
  }
}

/// The surrogate's best point is judged by the objective whatever limit holds.
void expect_best_surrogate_point_judged(const TextbookProblem& problem) {
  const std::vector<Record>& records = problem.surrogate()->records();
  const auto better = [](const Record& a, const Record& b) { return a.value < b.value; };
  const auto best = std::max_element(records.begin(), records.end(), better);
  EXPECT_TRUE(has_evaluated(problem, best->x)) << best->x.transpose();
}

TEST(Strategy, BoundsObjectiveAndSurrogateTogether) {
  const auto start = request_from(Eigen::Vector2d(-3.2, 0.1));
  const TextbookProblem whole(rastrigin_on_a_face());
  const SolveResult full = solve(whole, start);
  const std::int64_t most = full.evaluations + full.surrogate_evaluations;
  for (std::int64_t limit = 1; limit < most; ++limit) {
    SCOPED_TRACE(limit);
    SolveRequest request = start;
    request.stop.max_evaluations = limit;
    const TextbookProblem problem(rastrigin_on_a_face());
    const SolveResult result = solve(problem, request);
    ASSERT_LE(result.evaluations + result.surrogate_evaluations, limit);
    ASSERT_EQ(result.status, SolveStatus::evaluation_limit) << result.message;
    ASSERT_EQ(result.value, best_value(problem.records()));
    if (result.surrogate_evaluations > 0) expect_best_surrogate_point_judged(problem);
  }
}

TEST(Strategy, JudgesTheBestSoFarWhenCancelledInAnyStage) {
  for (const std::size_t cancelled_at : {1, 5, 40, 70}) {  // samples, global, local
    SCOPED_TRACE(cancelled_at);
    TextbookProblem problem(rastrigin_on_a_face());
    const SolveRequest request = request_from(Eigen::Vector2d(-3.2, 0.1));
    problem.surrogate()->before_evaluation = [&](std::size_t number) {
      if (number != cancelled_at) return;
      std::jthread([&] { request.stop.cancel.cancel(); }).join();
    };
    const SolveResult result = solve(problem, request);
    EXPECT_EQ(result.status, SolveStatus::cancelled);
    EXPECT_LE(problem.records().size(), 2U);
    EXPECT_LE(problem.surrogate()->records().size(),
              cancelled_at + std::max(1U, std::thread::hardware_concurrency()));
    expect_best_surrogate_point_judged(problem);
  }
}

TEST(Strategy, JudgesTheBestSoFarWhenTimeRunsOut) {
  TextbookProblem problem(rastrigin_on_a_face());
  SolveRequest request = request_from(Eigen::Vector2d(-3.2, 0.1));
  request.stop.deadline = StopRule::Clock::now() + std::chrono::milliseconds(50);
  problem.surrogate()->before_evaluation = [&](std::size_t) {
    std::this_thread::sleep_until(*request.stop.deadline);
  };
  const SolveResult result = solve(problem, request);
  EXPECT_EQ(result.status, SolveStatus::time_limit);
  EXPECT_LE(problem.surrogate()->records().size(), 1U);
  EXPECT_LE(problem.records().size(), 2U);
  expect_best_surrogate_point_judged(problem);
}

TEST(Strategy, SaysThatTimeRanOutInItsLastLocalSearch) {
  TextbookProblem problem(rastrigin_on_a_face());
  StrategyOptions options;
  options.polish.clear();
  options.local_starts = 1;
  SolveRequest request = request_from(Eigen::Vector2d(-3.2, 0.1));
  request.stop.deadline = StopRule::Clock::now() + std::chrono::milliseconds(50);
  problem.surrogate()->before_evaluation = [&](std::size_t) {
    std::this_thread::sleep_until(*request.stop.deadline);
  };
  EXPECT_EQ(solve(problem, request, options).status, SolveStatus::time_limit);
}

TEST(Strategy, LetsExceptionsOfTheSurrogateThrough) {
  for (const std::size_t thrown_at : {3, 40, 70}) {  // samples, global, local
    TextbookProblem problem(rastrigin_on_a_face());
    problem.surrogate()->before_evaluation = [&](std::size_t number) {
      if (number == thrown_at) throw std::domain_error("thrown");
    };
    EXPECT_THROW(solve(problem, request_from(Eigen::Vector2d(-3.2, 0.1))), std::domain_error);
  }
}

/// A surrogate that is wrong everywhere.
class Misled final : public Objective {
 public:
  Misled(const Objective& objective, double sign)
      : objective_(objective), misleading_(*this, sign) {}

  const Box& box() const override { return objective_.box(); }
  double value(const Point& x) const override { return objective_.value(x); }
  const Objective* surrogate() const override { return &misleading_; }

 private:
  class Misleading final : public Objective {
   public:
    Misleading(const Misled& owner, double sign) : owner_(owner), sign_(sign) {}
    const Box& box() const override { return owner_.box(); }
    double value(const Point& x) const override { return sign_ * owner_.objective_.value(x); }
    bool has_gradient() const override { return true; }
    double value_and_gradient(const Point& x, Point& gradient) const override {
      const double value = sign_ * owner_.objective_.value_and_gradient(x, gradient);
      gradient *= sign_;
      return value;
    }

   private:
    const Misled& owner_;
    double sign_;
  };

  const Objective& objective_;
  Misleading misleading_;
};

TEST(Strategy, IsNeverWorseThanTheStartWhateverTheSurrogateSays) {
  const TextbookProblem problem = quadratic({0.2, 0.3, 0.4});
  for (const double sign : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Misled misled(problem, sign);
    const Point start = Eigen::Vector3d(0.25, 0.35, 0.45);
    const SolveResult result = solve(misled, request_from(start));
    EXPECT_GE(result.value, problem.value(start));
    EXPECT_GT(result.value, kTop - 1e-3) << "the polish starts from the best, here the start";
  }
}

/// Five summits along a line; the surrogate takes each for what it is but for `flattery`, which it
/// adds to all but the best one.
class Flattering final : public Objective {
 public:
  explicit Flattering(double flattery) : surrogate_(flattery) {}

  const Box& box() const override { return surrogate_.box(); }
  double value(const Point& x) const override { return Summits(0.0).value(x); }
  const Objective* surrogate() const override { return &surrogate_; }

 private:
  class Summits final : public Objective {
   public:
    explicit Summits(double flattery) : flattery_(flattery) {}
    const Box& box() const override { return box_; }
    bool has_gradient() const override { return true; }
    double value(const Point& x) const override {
      Point gradient;
      return value_and_gradient(x, gradient);
    }
    double value_and_gradient(const Point& x, Point& gradient) const override {
      double value = 0.0;
      gradient.setZero(1);
      for (int i = 0; i < 5; ++i) {
        const double top = i == 4 ? 10.0 : 9.0 - 0.1 * i + flattery_;
        const double away = (x[0] - (1.0 + 2.0 * i)) / 0.4;
        const double term = top * std::exp(-0.5 * away * away);
        value += term;
        gradient[0] -= term * away / 0.4;
      }
      return value;
    }

   private:
    double flattery_;
    Box box_{Point::Zero(1), Point::Constant(1, 10.0)};
  };

  Summits surrogate_;
};

TEST(Strategy, JudgesOnAsLongAsTheSurrogateMayErrAsMuchAsItDid) {
  StrategyOptions options;
  options.polish.clear();
  // The surrogate ranks the best summit fifth, and shows by the first how much it errs.
  const Flattering misleading(2.0);
  EXPECT_NEAR(solve(misleading, request_from(Point::Zero(1)), options).value, 10.0, 0.01);
  options.polish_candidates = 2;
  EXPECT_LT(solve(misleading, request_from(Point::Zero(1)), options).value, 9.5);
}

TEST(Strategy, JudgesNoMoreThanItMustWhereTheSurrogateIsRight) {
  StrategyOptions options;
  options.polish.clear();
  const Flattering right(0.0);
  const SolveResult result = solve(right, request_from(Point::Zero(1)), options);
  EXPECT_NEAR(result.value, 10.0, 0.01);
  EXPECT_EQ(result.evaluations, 1 + 3) << "the start and three summits of five";
}

/// A slanting ridge with a kink at its summit, to the precision of a coarse number: line searches
/// end there without having met a tolerance.
class CoarseRidge final : public Objective {
 public:
  const Box& box() const override { return box_; }
  const Objective* surrogate() const override { return this; }
  bool has_gradient() const override { return true; }
  double value(const Point& x) const override {
    Point gradient(2);
    return value_and_gradient(x, gradient);
  }
  double value_and_gradient(const Point& x, Point& gradient) const override {
    constexpr double kPrecision = 1e-3;
    const double along = x[0] - 0.3;
    const double beside = x[1] + 0.4 - 0.5 * along;
    const double value = 5.0 - along * along - 0.5 * std::abs(along) - 100.0 * beside * beside;
    gradient =
        Eigen::Vector2d(-2.0 * along - std::copysign(0.5, along) + 100.0 * beside, -200.0 * beside);
    return std::floor(value / kPrecision) * kPrecision;
  }

 private:
  Box box_{Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)};
};

TEST(Strategy, TakesForASummitWhereNoLineSearchGoesHigher) {
  StrategyOptions options;
  options.local_tolerance = 1e-4;
  options.local_evaluations = 1000;
  options.polish.clear();
  const SolveResult result = solve(CoarseRidge(), request_from(Eigen::Vector2d(0.9, 0.9)), options);
  EXPECT_NEAR(result.value, 5.0, 0.01);
  EXPECT_EQ(result.status, SolveStatus::converged) << result.message;
}

TEST(Strategy, AnswersTheSameToTheLastBit) {
  const SolveRequest request = request_from(Eigen::Vector2d(-3.2, 0.1));
  const TextbookProblem first(rastrigin_on_a_face());
  const SolveResult expected = solve(first, request);
  for (const std::size_t threads : {1, 2, 3}) {
    TextbookProblem problem(rastrigin_on_a_face());
    problem.use_threads(threads);
    const SolveResult result = solve(problem, request);
    EXPECT_EQ(result.best, expected.best);
    EXPECT_EQ(result.value, expected.value);
    EXPECT_EQ(result.evaluations, expected.evaluations);
    EXPECT_EQ(result.surrogate_evaluations, expected.surrogate_evaluations);
    EXPECT_EQ(result.message, expected.message);
  }
}

TEST(Strategy, IsNamedByItsStages) {
  StrategyOptions options;
  EXPECT_EQ(make_strategy(options)->name(), "nlopt:direct-l + nlopt:lbfgs + nlopt:cobyla");
  options.local.clear();
  EXPECT_EQ(make_strategy(options)->name(), "nlopt:direct-l + nlopt:cobyla");
}

TEST(Strategy, RefusesSolversThatCannotWorkInTheirStage) {
  const auto with = [](std::string StrategyOptions::*stage, const std::string& name) {
    StrategyOptions options;
    options.*stage = name;
    return refusal(options);
  };
  EXPECT_THAT(with(&StrategyOptions::global, "nlopt:direkt"),
              AllOf(HasSubstr("global stage"), HasSubstr("\"nlopt:direkt\""), HasSubstr("ags")));
  EXPECT_THAT(with(&StrategyOptions::local, "newton"), HasSubstr("local stage"));
  EXPECT_THAT(with(&StrategyOptions::polish, "auto"), HasSubstr("polish stage"));
  EXPECT_THAT(with(&StrategyOptions::global, "grid"), HasSubstr("grid"));
  EXPECT_THAT(refusal({.global = "", .local = "", .polish = ""}), HasSubstr("every stage"));
}

TEST(Strategy, RefusesOptionsOutOfRangeByName) {
  const auto with = [](auto StrategyOptions::*field, auto value) {
    StrategyOptions options;
    options.*field = value;
    return refusal(options);
  };
  EXPECT_THAT(with(&StrategyOptions::line_points, -1), HasSubstr("line_points = -1"));
  EXPECT_THAT(with(&StrategyOptions::global_evaluations, 0), HasSubstr("global_evaluations = 0"));
  EXPECT_THAT(with(&StrategyOptions::local_starts, 0), HasSubstr("local_starts = 0"));
  EXPECT_THAT(with(&StrategyOptions::start_separation, -0.1), HasSubstr("start_separation"));
  EXPECT_THAT(with(&StrategyOptions::local_evaluations, 0), HasSubstr("local_evaluations = 0"));
  EXPECT_THAT(with(&StrategyOptions::local_tolerance, 0.0), HasSubstr("local stage: tolerance"));
  EXPECT_THAT(with(&StrategyOptions::polish_candidates, 0), HasSubstr("polish_candidates = 0"));
  EXPECT_THAT(with(&StrategyOptions::polish_step, -1.0), HasSubstr("polish stage: initial_step"));
  EXPECT_THAT(with(&StrategyOptions::polish_evaluations, 0), HasSubstr("polish_evaluations = 0"));
}

TEST(Strategy, ChecksWhatItsStagesNeedBeforeItEvaluates) {
  const TextbookProblem problem = quadratic({0.2, 0.3, 0.4});
  const Misled misled(problem, 1.0);  // gradient of the surrogate only, residuals of none
  const SolveRequest request = request_from(Eigen::Vector3d(0, 0, 0));
  const auto message = [&](const StrategyOptions& options) -> std::string {
    try {
      solve(misled, request, options);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no UsageError";
  };
  StrategyOptions options;
  options.polish = "nlopt:lbfgs";
  EXPECT_THAT(message(options), AllOf(HasSubstr("polish stage"), HasSubstr("gradient")));
  options = {};
  options.local = "ceres:lm";
  EXPECT_THAT(message(options), AllOf(HasSubstr("local stage"), HasSubstr("residuals")));
  EXPECT_TRUE(problem.records().empty());
}

}  // namespace
}  // namespace nbvopt
