// The table of solvers, and the parameters that several of them share.
#include "nbvopt/solver/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const std::string& name, const Search& options = {}) {
  try {
    make_solver(name, options);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no UsageError";
}

TEST(Registry, KnowsTheSolversOfTheDesign) {
  EXPECT_THAT(
      solver_names(),
      testing::UnorderedElementsAre(
          "auto", "grid", "random", "nlopt:direct-l", "nlopt:crs2", "nlopt:isres", "nlopt:esch",
          "nlopt:mlsl-lds", "nlopt:stogo", "nlopt:ags", "nlopt:lbfgs", "nlopt:slsqp", "nlopt:mma",
          "nlopt:bobyqa", "nlopt:sbplx", "nlopt:cobyla", "ceres:lbfgs", "ceres:lm"));
}

TEST(Registry, AnUnknownNameListsTheKnown) {
  EXPECT_THAT(refusal("nlopt:newuoa"),
              AllOf(HasSubstr("\"nlopt:newuoa\""), HasSubstr("grid, random, nlopt:direct-l"),
                    HasSubstr("ceres:lm")));
  EXPECT_THAT(refusal(""), HasSubstr("grid"));
}

TEST(Registry, RefusesABadTolerance) {
  Search options;
  for (const double tolerance : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    options.tolerance = tolerance;
    EXPECT_THAT(refusal("nlopt:sbplx", options), HasSubstr("tolerance = "));
    EXPECT_THAT(refusal("ceres:lbfgs", options), HasSubstr("tolerance = "));
    EXPECT_THAT(refusal("ceres:lm", options), HasSubstr("tolerance = "));
  }
}

TEST(Registry, RefusesAFirstStepThatIsNoLength) {
  Search options;
  for (const double step :
       {-0.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    options.initial_step = step;
    EXPECT_THAT(refusal("nlopt:sbplx", options), HasSubstr("initial_step = "));
  }
}

TEST(Registry, SaysWhatSolversHeed) {
  EXPECT_TRUE(heeds("grid", SearchParameters::grid_steps));
  EXPECT_TRUE(heeds("nlopt:sbplx", SearchParameters::tolerances));
  EXPECT_TRUE(heeds("ceres:lm", SearchParameters::tolerances));
  EXPECT_TRUE(heeds("auto", SearchParameters::stages));
  EXPECT_FALSE(heeds("auto", SearchParameters::tolerances));
  EXPECT_FALSE(heeds("random", SearchParameters::grid_steps));
  EXPECT_FALSE(heeds("nlopt:nothing", SearchParameters::tolerances));
  EXPECT_THAT(solvers_that_heed(SearchParameters::tolerances),
              testing::ElementsAre("nlopt:*", "ceres:*"));
}

TEST(Registry, MakesTheSolverOfASearch) {
  EXPECT_EQ(make_solver(Search{})->name(), "auto");
  EXPECT_EQ(make_solver(Search{.solver = "random"})->name(), "random");
  EXPECT_EQ(make_solver(Search{.stages = StrategyOptions{.global = "", .local = ""}})->name(),
            StrategyOptions{}.polish);
  EXPECT_THROW(make_solver(Search{.solver = "auto", .stages = StrategyOptions{}}), UsageError);
}

TEST(Registry, ReadsStagesAsUsersNameThem) {
  EXPECT_EQ(named_stages({}, {}, {}), std::nullopt);
  EXPECT_EQ(named_stages("none", {}, "nlopt:sbplx"),
            (StrategyOptions{.global = "", .polish = "nlopt:sbplx"}));
  EXPECT_THROW(named_stages({}, "", {}), UsageError);
}

}  // namespace
}  // namespace nbvopt
