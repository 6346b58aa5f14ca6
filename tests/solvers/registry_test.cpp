// The table of solvers, and the options that all of them share.
#include "nbvopt/solver/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const std::string& name, const SolverOptions& options = {}) {
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
  SolverOptions options;
  for (const double tolerance : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    options.tolerance = tolerance;
    EXPECT_THAT(refusal("nlopt:sbplx", options), HasSubstr("tolerance = "));
    EXPECT_THAT(refusal("ceres:lbfgs", options), HasSubstr("tolerance = "));
    EXPECT_THAT(refusal("ceres:lm", options), HasSubstr("tolerance = "));
  }
}

TEST(Registry, RefusesAFirstStepThatIsNoLength) {
  SolverOptions options;
  for (const double step :
       {-0.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    options.initial_step = step;
    EXPECT_THAT(refusal("nlopt:sbplx", options), HasSubstr("initial_step = "));
  }
}

}  // namespace
}  // namespace nbvopt
