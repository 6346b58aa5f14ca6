// The contract of every solver in the registry, on textbook functions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "contract/solver_contract_problem.hpp"
#include "nbvopt/solver/registry.hpp"

namespace nbvopt {
namespace {

using testing_contract::plateau;
using testing_contract::quadratic;
using testing_contract::quadratic_over;
using testing_contract::quadratic_with_nan;
using testing_contract::rastrigin;
using testing_contract::Record;
using testing_contract::TextbookProblem;

constexpr double kTop = TextbookProblem::kTop;

const std::set<std::string> kGlobal{"auto",        "grid",        "random",     "nlopt:direct-l",
                                    "nlopt:crs2",  "nlopt:isres", "nlopt:esch", "nlopt:mlsl-lds",
                                    "nlopt:stogo", "nlopt:ags"};
const std::set<std::string> kSeeded{"random", "nlopt:crs2", "nlopt:isres", "nlopt:esch"};

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_bits(const Point& a, const Point& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double p, double q) { return same_bits(p, q); });
}

SolveRequest request_from(const Point& start) {
  SolveRequest request;
  request.start = start;
  return request;
}

SolveRequest request_from(const Point& start, std::int64_t max_evaluations) {
  SolveRequest request = request_from(start);
  request.stop.max_evaluations = max_evaluations;
  return request;
}

/// What every answer keeps, judged by the problem's own notes.
void expect_contract(const SolveResult& result, const TextbookProblem& problem,
                     const SolveRequest& request) {
  const std::vector<Record>& records = problem.records();
  EXPECT_NE(result.status, SolveStatus::not_run);
  EXPECT_FALSE(result.message.empty());
  EXPECT_EQ(result.evaluations, static_cast<std::int64_t>(records.size()));
  EXPECT_LE(result.evaluations + result.surrogate_evaluations, request.stop.max_evaluations);
  const std::vector<Record>& surrogate_records = problem.surrogate()->records();
  EXPECT_EQ(result.surrogate_evaluations, static_cast<std::int64_t>(surrogate_records.size()));
  for (const Record& record : surrogate_records) {
    EXPECT_TRUE(problem.box().contains(record.x)) << record.x.transpose();
  }
  EXPECT_TRUE(problem.box().contains(result.best)) << result.best.transpose();

  const auto evaluated = [&](const Point& x) {
    return std::any_of(records.begin(), records.end(),
                       [&](const Record& record) { return same_bits(record.x, x); });
  };
  EXPECT_TRUE(evaluated(request.start));
  EXPECT_TRUE(evaluated(result.best));
  for (const Record& record : records) {
    EXPECT_TRUE(problem.box().contains(record.x)) << record.x.transpose();
    EXPECT_FALSE(record.value > result.value) << "better than the answer: " << record.x.transpose();
    EXPECT_FALSE(std::isnan(result.value) && !std::isnan(record.value));
    if (record.value == result.value) {
      EXPECT_LE(problem.tie_cost(result.best), problem.tie_cost(record.x));
    }
    if (same_bits(record.x, result.best)) {
      EXPECT_TRUE(same_bits(record.value, result.value));
    }
  }
}

class SolverContract : public testing::TestWithParam<std::string> {
 protected:
  bool is_global() const { return kGlobal.contains(GetParam()); }

  bool is_strategy() const { return make_solver(GetParam(), {})->needs().surrogate; }

  static SolveResult solve(const std::string& name, const Objective& objective,
                           const SolveRequest& request) {
    Search options;
    const Point steps = (objective.box().upper - objective.box().lower) / 12.0;
    options.grid_steps.assign(steps.begin(), steps.end());
    return make_solver(name, options)->solve(objective, request);
  }

  SolveResult solve(const Objective& objective, const SolveRequest& request) const {
    return solve(GetParam(), objective, request);
  }

  /// How far below the top a solver may end on a smooth function with one optimum.
  double allowed_gap() const { return is_global() ? 0.2 : 1e-4; }

  /// The same for an optimum on a face, which global solvers sample at random or approach by
  /// halves; StoGO drops its local searches there. The start lies 7 and more below.
  double allowed_gap_on_face() const { return is_global() ? 2.5 : 1e-4; }
};

TEST_P(SolverContract, IsMadeUnderItsName) {
  EXPECT_EQ(make_solver(GetParam(), {})->name(), GetParam());
}

TEST_P(SolverContract, FindsAnOptimumInside) {
  const auto problem = quadratic({0.21, 0.33, 0.47});
  const SolveRequest request = request_from(Eigen::Vector3d(-0.5, 1.5, 1.0), 2000);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_GT(result.value, kTop - allowed_gap());
}

TEST_P(SolverContract, FindsAnOptimumOnAFace) {
  const auto problem = quadratic({0.21, 3.0, 0.47});
  const SolveRequest request = request_from(Eigen::Vector3d(-0.5, 1.5, 1.0), 2000);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  const double best_value = kTop - 4.0;
  EXPECT_GT(result.value, best_value - allowed_gap_on_face());
}

TEST_P(SolverContract, FindsAnOptimumInACorner) {
  const auto problem = quadratic({-2.0, 3.0, 4.0});
  const SolveRequest request = request_from(Eigen::Vector3d(-0.5, 1.5, 1.0), 2000);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  const double best_value = kTop - 1.0 - 4.0 - 1.0;
  EXPECT_GT(result.value, best_value - allowed_gap_on_face());
}

TEST_P(SolverContract, LeavesEveryCorner) {
  for (int corner = 0; corner < 8; ++corner) {
    SCOPED_TRACE(corner);
    const auto problem = quadratic({0.21, 0.33, 0.47});
    const auto end = [&](int bit) { return (corner >> bit) & 1 ? 2.0 : -1.0; };
    const SolveRequest request = request_from(Eigen::Vector3d(end(0), end(1), end(2)), 2000);
    const SolveResult result = solve(problem, request);
    expect_contract(result, problem, request);
    EXPECT_GT(result.value, kTop - allowed_gap());
  }
}

TEST_P(SolverContract, EscapesLocalOptimaIfItIsGlobal) {
  const auto problem = rastrigin();
  const SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9), 4000);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  // The start is worth about -34; the basins next to the global one reach kTop - 1.
  if (is_global() && GetParam() != "grid") {
    EXPECT_GT(result.value, kTop - 2.5);
  }
}

TEST_P(SolverContract, BreaksTiesByCost) {
  for (const Point& start :
       {Point(Eigen::Vector2d(1.0, 1.05)), Point(Eigen::Vector2d(-1.5, 1.8))}) {
    const auto problem = plateau();
    const SolveRequest request = request_from(start, 300);
    expect_contract(solve(problem, request), problem, request);
  }
}

TEST_P(SolverContract, EndsWithoutAnEvaluationLimit) {
  const auto problem = rastrigin();
  const SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9));
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_LE(result.evaluations, 400);  // 200 a coordinate; the grid has 170 points
}

TEST_P(SolverContract, ObeysTheEvaluationLimitExactly) {
  for (const std::int64_t limit : {1, 2, 5, 17, 100}) {
    SCOPED_TRACE(limit);
    const auto problem = rastrigin();
    const SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9), limit);
    const SolveResult result = solve(problem, request);
    expect_contract(result, problem, request);
    if (limit <= 5 || result.status == SolveStatus::evaluation_limit) {
      // A strategy's stages have their shares, and may leave some of them.
      EXPECT_TRUE(is_strategy() || result.evaluations == limit) << result.evaluations;
      EXPECT_EQ(result.status, SolveStatus::evaluation_limit);
    }
  }
}

TEST_P(SolverContract, ReturnsTheStartWhenTheDeadlineIsPast) {
  const auto problem = rastrigin();
  SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9));
  request.stop.deadline = StopRule::Clock::now() - std::chrono::seconds(1);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_EQ(result.status, SolveStatus::time_limit);
  EXPECT_EQ(result.evaluations, 1);
}

TEST_P(SolverContract, ReturnsTheStartWhenCancelledBefore) {
  const auto problem = rastrigin();
  const SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9));
  request.stop.cancel.cancel();
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_EQ(result.status, SolveStatus::cancelled);
  EXPECT_EQ(result.evaluations, 1);
}

TEST_P(SolverContract, StopsSoonWhenCancelledByAnotherThread) {
  constexpr std::size_t kCancelledAt = 4;
  auto problem = rastrigin();
  const SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9), 1'000'000'000);
  std::promise<void> reached;
  std::promise<void> cancelled;
  problem.before_evaluation = [&](std::size_t number) {
    if (number != kCancelledAt) return;
    reached.set_value();
    cancelled.get_future().wait();
  };
  const std::jthread canceller([&] {
    reached.get_future().wait();
    request.stop.cancel.cancel();
    cancelled.set_value();
  });
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_EQ(result.status, SolveStatus::cancelled);
  // The evaluation under way, and at most the rest of a batch of one a core.
  EXPECT_LE(problem.records().size(),
            kCancelledAt + std::max(1U, std::thread::hardware_concurrency()));
}

TEST_P(SolverContract, LetsExceptionsThroughAsTheyAre) {
  class OwnError : public std::domain_error {
   public:
    using std::domain_error::domain_error;
  };
  for (const std::size_t throws_at : {1, 2, 4}) {
    SCOPED_TRACE(throws_at);
    auto problem = rastrigin();
    problem.before_evaluation = [&](std::size_t number) {
      if (number == throws_at) throw OwnError("evaluation " + std::to_string(number));
    };
    try {
      solve(problem, request_from(Eigen::Vector2d(-3.4, 3.9), 200));
      ADD_FAILURE() << "nothing thrown";
    } catch (const OwnError& error) {
      EXPECT_EQ(error.what(), "evaluation " + std::to_string(throws_at));
    }
    EXPECT_EQ(problem.records().size(), throws_at - 1);
  }
}

TEST_P(SolverContract, SurvivesNan) {
  const std::vector<std::pair<std::string, std::function<bool(const Point&)>>> cases{
      {"half of the box", [](const Point& x) { return x[0] > 0.3; }},
      {"the start", [](const Point& x) { return x[0] < -0.3 && x[1] > 1.2; }},
      {"everywhere", [](const Point&) { return true; }},
  };
  for (const auto& [where, is_nan] : cases) {
    SCOPED_TRACE(where);
    const auto problem = quadratic_with_nan(is_nan);
    const SolveRequest request = request_from(Eigen::Vector3d(-0.5, 1.5, 1.0), 300);
    const SolveResult result = solve(problem, request);
    expect_contract(result, problem, request);
    if (where == "everywhere") {
      EXPECT_TRUE(same_bits(result.best, request.start));
    }
  }
}

TEST_P(SolverContract, AnswersABoxOfZeroWidthWithTheStart) {
  const Point only = Eigen::Vector3d(0.1, 0.7, -0.3);
  const auto problem = quadratic_over({only, only});
  const SolveRequest request = request_from(only);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_TRUE(same_bits(result.best, only));
  EXPECT_EQ(result.evaluations, 1);
  EXPECT_EQ(result.status,
            GetParam() == "grid" ? SolveStatus::grid_complete : SolveStatus::converged);
}

TEST_P(SolverContract, KeepsAFrozenCoordinate) {
  const Box box{Eigen::Vector3d(-1.0, 0.1, -1.0), Eigen::Vector3d(2.0, 0.1, 2.0)};
  const auto problem = quadratic_over(box);
  const SolveRequest request = request_from(Eigen::Vector3d(-0.7, 0.1, 1.6), 2000);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  const double best_value = kTop - std::pow(2.0 * (0.3 - 0.1), 2);
  EXPECT_GT(result.value, best_value - allowed_gap());
}

TEST_P(SolverContract, RunsWithOneFreeCoordinate) {
  const Box box{Eigen::Vector3d(0.2, 0.3, -1.0), Eigen::Vector3d(0.2, 0.3, 2.0)};
  const auto problem = quadratic_over(box);
  const SolveRequest request = request_from(Eigen::Vector3d(0.2, 0.3, 1.6), 500);
  const SolveResult result = solve(problem, request);
  expect_contract(result, problem, request);
  EXPECT_GT(result.value, kTop - allowed_gap());
}

TEST_P(SolverContract, StaysInBoxesWhoseFacesRound) {
  const Box box{Eigen::Vector3d(0.1, -0.7, 1e-3), Eigen::Vector3d(0.3, 0.1, 1e-3 + 1e-9)};
  const auto problem = quadratic_over(box);
  const SolveRequest request = request_from(Eigen::Vector3d(0.3, 0.1, 1e-3), 300);
  expect_contract(solve(problem, request), problem, request);
}

TEST_P(SolverContract, RepeatsItselfBitForBit) {
  SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9), 300);
  request.seed = 42;
  const auto first = rastrigin();
  const SolveResult expected = solve(first, request);
  const auto second = rastrigin();
  solve(second, request);
  const auto third = rastrigin();  // random generators that belong to a thread start afresh there
  std::jthread([&] { solve(third, request); }).join();
  for (const TextbookProblem* again : {&second, &third}) {
    ASSERT_EQ(again->records().size(), first.records().size());
    for (std::size_t i = 0; i < first.records().size(); ++i) {
      ASSERT_TRUE(same_bits(again->records()[i].x, first.records()[i].x)) << "evaluation " << i;
    }
  }
  for (const std::size_t threads : {2, 3}) {
    auto problem = rastrigin();
    problem.use_threads(threads);
    const SolveResult result = solve(problem, request);
    EXPECT_TRUE(same_bits(result.best, expected.best));
    EXPECT_TRUE(same_bits(result.value, expected.value));
    EXPECT_EQ(result.evaluations, expected.evaluations);
  }
}

/// The solvers that draw at random.
class SeededSolverContract : public SolverContract {};

TEST_P(SeededSolverContract, ListensToItsSeed) {
  SolveRequest request = request_from(Eigen::Vector2d(-3.4, 3.9), 50);
  const auto first = rastrigin();
  solve(first, request);
  request.seed = 2;
  const auto second = rastrigin();
  solve(second, request);
  EXPECT_FALSE(same_bits(first.records().back().x, second.records().back().x));
}

TEST_P(SolverContract, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const SolveRequest request = request_from(Eigen::Vector3d(-0.5, 1.5, 1.0), 300);
  for (const double nan_from : {-2.0, 0.3}) {
    solve(quadratic_with_nan([&](const Point& x) { return x[0] > nan_from; }), request);
  }
  solve(plateau(), request_from(Eigen::Vector2d(0.5, 0.5), 300));
  solve(rastrigin(), request_from(Eigen::Vector2d(-3.4, 3.9), 3));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ':' || c == '-'; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, SolverContract, testing::ValuesIn(solver_names()), test_name);
INSTANTIATE_TEST_SUITE_P(All, SeededSolverContract, testing::ValuesIn(kSeeded), test_name);

}  // namespace
}  // namespace nbvopt
