#include "study/evaluate/profiles.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "study/evaluate/ratio.hpp"
#include "study/made_results.hpp"
#include "support/numbers.hpp"

namespace nbvopt::study {
namespace {

using test::kNaN;
using testing::DoubleEq;
using testing::ElementsAre;

TEST(PerformanceProfile, IsTheDistributionOfCostsOverTheLeast) {
  Results results = made_results({"auto", "slow", "never"}, {100.0, 100.0, 100.0, kNaN});
  results.runs = {
      made_run({.case_index = 0, .solver = 0, .gain = 100.0, .evaluations = 10, .time_ms = 6.0}),
      made_run({.case_index = 0, .solver = 1, .gain = 99.0, .evaluations = 30, .time_ms = 2.0}),
      made_run({.case_index = 1, .solver = 0, .gain = 100.0, .evaluations = 10}),
      made_run({.case_index = 1, .solver = 1, .gain = 98.0, .evaluations = 5}),
      made_run({.case_index = 2, .solver = 0, .gain = 100.0, .evaluations = 40}),
      failed_run({.case_index = 2, .solver = 0, .seed = 2}),
      made_run({.case_index = 2, .solver = 1, .gain = 100.0, .evaluations = 20}),
      made_run({.case_index = 2, .solver = 1, .gain = 100.0, .evaluations = 20, .seed = 2}),
      made_run({.case_index = 2, .solver = 2, .gain = 10.0, .evaluations = 1}),
      made_run({.case_index = 3, .solver = 0, .gain = 10.0, .evaluations = 1})};
  const std::vector<SolverProfiles> profiles = performance_profiles(results, 0.99);
  ASSERT_EQ(profiles.size(), 3U);
  EXPECT_THAT(profiles[0].evaluations.costs, ElementsAre(1.0, 1.0, 2.0));
  EXPECT_EQ(profiles[0].evaluations.questions, 4U);
  EXPECT_THAT(profiles[0].time_ms.costs, ElementsAre(1.0, 1.0, 3.0));
  EXPECT_THAT(profiles[1].evaluations.costs, ElementsAre(1.0, 1.0, 3.0));
  EXPECT_EQ(profiles[1].evaluations.questions, 4U);
  EXPECT_EQ(profiles[0].evaluations.share_within(1.0), 0.5);
  EXPECT_EQ(profiles[0].evaluations.share_within(1.99), 0.5);
  EXPECT_EQ(profiles[0].evaluations.share_within(2.0), 0.75);
  EXPECT_EQ(profiles[2].evaluations.share_answered(), 0.0) << "never reached the target";
  EXPECT_EQ(profiles[2].evaluations.questions, 1U) << "asked where it has a run";
}

TEST(PerformanceProfile, ComparesRunsOfOneSeed) {
  Results results = made_results({"auto", "random"}, {100.0});
  results.runs = {made_run({.solver = 0, .gain = 100.0, .evaluations = 10, .seed = 1}),
                  made_run({.solver = 0, .gain = 100.0, .evaluations = 40, .seed = 2}),
                  made_run({.solver = 1, .gain = 100.0, .evaluations = 20, .seed = 1}),
                  made_run({.solver = 1, .gain = 100.0, .evaluations = 20, .seed = 2})};
  const std::vector<SolverProfiles> profiles = performance_profiles(results, 0.99);
  EXPECT_THAT(profiles[0].evaluations.costs, ElementsAre(1.0, 2.0));
  EXPECT_THAT(profiles[1].evaluations.costs, ElementsAre(1.0, 2.0));
}

TEST(PerformanceProfile, OfViewsThatCostNothingIsFinite) {
  Results results = made_results({"auto", "random"}, {0.0});
  results.runs = {made_run({.solver = 0, .evaluations = 0, .time_ms = 0.0}),
                  made_run({.solver = 1, .evaluations = 4, .time_ms = 0.5})};
  const std::vector<SolverProfiles> profiles = performance_profiles(results, 0.99);
  EXPECT_THAT(profiles[0].evaluations.costs, ElementsAre(1.0));
  EXPECT_THAT(profiles[1].evaluations.costs, ElementsAre(4.0));
  EXPECT_THAT(profiles[1].time_ms.costs, ElementsAre(DoubleEq(500.0)));
}

TEST(DataProfile, TargetsAreSpacedInLogarithm) {
  const std::vector<double> targets = data_profile_targets();
  ASSERT_EQ(targets.size(), 41U);
  EXPECT_DOUBLE_EQ(targets.front(), 0.7);
  EXPECT_DOUBLE_EQ(targets.back(), 0.999);
  EXPECT_NEAR(1.0 - targets[20], std::sqrt(0.3 * 0.001), 1e-12);
}

TEST(DataProfile, CountsRunsAndTargets) {
  Results results = made_results({"auto", "random"}, {100.0, 100.0});
  auto run = made_run({.case_index = 0, .gain = 99.9, .evaluations = 50, .time_ms = 5.0});
  run.progress = {{.evaluations = 3, .exact_evaluations = 3, .time_ms = 0.5, .gain = 80.0}};
  results.runs = {run, failed_run({.case_index = 1})};
  const std::vector<SolverProfiles> profiles = data_profiles(results, {0.7, 0.75, 0.999});
  EXPECT_EQ(profiles[0].evaluations.questions, 6U);
  EXPECT_THAT(profiles[0].evaluations.costs, ElementsAre(3.0, 3.0, 50.0));
  EXPECT_THAT(profiles[0].time_ms.costs, ElementsAre(0.5, 0.5, 5.0));
  EXPECT_EQ(profiles[0].time_ms.share_within(1.0), 2.0 / 6.0);
  EXPECT_EQ(profiles[0].time_ms.share_answered(), 0.5);
  EXPECT_TRUE(std::isnan(profiles[1].evaluations.share_within(1.0))) << "was asked nothing";
}

/// Three solvers of which the last reaches less; each run improves in steps.
Results random_results() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Results results = made_results({"a", "b", "c"}, std::vector<double>(20, 100.0));
  for (std::size_t i = 0; i < results.cases.size(); ++i) {
    for (std::size_t solver = 0; solver < 3; ++solver) {
      auto run = made_run({.case_index = i, .solver = solver, .evaluations = 100, .time_ms = 10.0});
      double missed = 50.0;
      for (std::int64_t at = 1; at < 100; at += 10) {
        run.progress.push_back({at, at, 0.1 * static_cast<double>(at), 100.0 - missed});
        run.gain = 100.0 - missed;
        missed *= uniform(random) + (solver == 2 ? 0.2 : 0.0);
      }
      results.runs.push_back(run);
    }
  }
  return results;
}

TEST(Profiles, GrowToTheShareOfSuccesses) {
  const Results results = random_results();
  const std::vector<SolverProfiles> profiles = performance_profiles(results, 0.99);
  double best_at_1 = 0.0;
  for (std::size_t solver = 0; solver < 3; ++solver) {
    double successes = 0.0;
    for (const auto& run : results.runs) {
      if (run.solver == solver && gain_ratio(results, run) >= 0.99) ++successes;
    }
    const Profile& profile = profiles[solver].evaluations;
    double before = 0.0;
    for (double tau = 1.0; tau < 2000.0; tau *= 1.1) {
      EXPECT_GE(profile.share_within(tau), before);
      before = profile.share_within(tau);
    }
    EXPECT_EQ(before, successes / 20.0);
    EXPECT_EQ(profile.share_answered(), successes / 20.0);
    best_at_1 += profile.share_within(1.0);
  }
  EXPECT_GE(best_at_1, 1.0) << "somebody is the best everywhere";
}

}  // namespace
}  // namespace nbvopt::study
