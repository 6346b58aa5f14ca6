#include "report/signed_rank.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace nbvopt {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

// Values of p and the lesser rank sum are those of SciPy 1.10.1:
// scipy.stats.wilcoxon(d, correction=False, method='exact') or method='approx'.

TEST(SignedRank, OfFewIsExact) {
  const SignedRankTest test =
      signed_rank_test({0.011, -0.002, 0.007, 0.013, -0.004, 0.009, 0.001, 0.006});
  EXPECT_TRUE(test.is_exact);
  EXPECT_EQ(test.pairs, 8U);
  EXPECT_EQ(test.rank_sum_above, 31.0);
  EXPECT_EQ(test.rank_sum_below, 5.0);
  EXPECT_NEAR(test.p, 0.078125, 1e-15);
  EXPECT_DOUBLE_EQ(test.rank_biserial, 26.0 / 36.0);

  EXPECT_NEAR(signed_rank_test({1, 2, 3, -6}).p, 0.875, 1e-15);
  EXPECT_NEAR(signed_rank_test({1, 2, 3, -4, -5, -6, 7}).p, 0.9375, 1e-15);
}

/// Distinct sizes, of both signs.
std::vector<double> shuffled(int count) {
  std::vector<double> differences;
  for (int i = 0; i < count; ++i) differences.push_back(((i * 37) % 61 - 27.25) / 1000.0);
  return differences;
}

TEST(SignedRank, IsExactUpTo50Pairs) {
  const SignedRankTest test = signed_rank_test(shuffled(50));
  EXPECT_TRUE(test.is_exact);
  EXPECT_EQ(std::min(test.rank_sum_above, test.rank_sum_below), 552.0);
  EXPECT_NEAR(test.p, 0.4151920088524754, 1e-12);
}

TEST(SignedRank, OfManyIsApproximate) {
  const SignedRankTest test = signed_rank_test(shuffled(60));
  EXPECT_FALSE(test.is_exact);
  EXPECT_EQ(std::min(test.rank_sum_above, test.rank_sum_below), 753.0);
  EXPECT_NEAR(test.p, 0.2330340253971983, 1e-12);
}

TEST(SignedRank, TiesShareTheirRanksAndZerosAreDropped) {
  const double noise = 1e-10;
  const SignedRankTest test = signed_rank_test(
      {0.01, 0.0, 0.01 + noise, -0.01, 0.02, 0.03, -0.02, noise, 0.04, 0.04, 0.05, -0.01, 0.02});
  EXPECT_EQ(test.zeros, 2U);
  EXPECT_EQ(test.pairs, 11U);
  EXPECT_TRUE(test.is_exact);
  EXPECT_EQ(test.rank_sum_below, 11.0);
  EXPECT_DOUBLE_EQ(test.p, 0.0556640625) << "114 of 2048 signs, enumerated";
}

TEST(SignedRank, OfFewPairsIsNeverLessThanTheirSignsAllow) {
  EXPECT_DOUBLE_EQ(signed_rank_test({0.1, 0.1, 0.2, 0.3, 0.4}).p, 2.0 / 32.0);
}

TEST(SignedRank, OfNoDifferenceSaysNothing) {
  const SignedRankTest test = signed_rank_test({0.0, 1e-12, -1e-10});
  EXPECT_EQ(test.zeros, 3U);
  EXPECT_EQ(test.p, 1.0);
  EXPECT_EQ(test.rank_biserial, 0.0);
}

TEST(SignedRank, DoesNotDependOnWhoIsFirst) {
  std::vector<double> turned = shuffled(40);
  for (double& difference : turned) difference = -difference;
  EXPECT_DOUBLE_EQ(signed_rank_test(turned).p, signed_rank_test(shuffled(40)).p);
  EXPECT_DOUBLE_EQ(signed_rank_test(turned).rank_biserial,
                   -signed_rank_test(shuffled(40)).rank_biserial);
}

TEST(Holm, StepsDown) {
  // 4 x 0.005, 3 x 0.01, 2 x 0.03 and 1 x 0.04, the last lifted to the one before.
  EXPECT_THAT(holm({0.01, 0.04, 0.03, 0.005}),
              ElementsAre(DoubleNear(0.03, 1e-15), DoubleNear(0.06, 1e-15), DoubleNear(0.06, 1e-15),
                          DoubleNear(0.02, 1e-15)));
  EXPECT_THAT(holm({0.7, 0.6}), ElementsAre(1.0, 1.0)) << "no more than 1";
  EXPECT_THAT(holm({0.02}), ElementsAre(0.02));
}

TEST(Holm, PassesOverTestsThatWereNotMade) {
  const std::vector<double> corrected =
      holm({0.01, std::numeric_limits<double>::quiet_NaN(), 0.04});
  EXPECT_EQ(corrected[0], 0.02);
  EXPECT_TRUE(std::isnan(corrected[1]));
  EXPECT_EQ(corrected[2], 0.04);
}

}  // namespace
}  // namespace nbvopt
