#include "report/signed_rank.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nbvopt {
namespace {

constexpr double kNoise = 1e-9;

struct Ranks {
  std::vector<double> rank;     ///< of each difference
  double tie_correction = 0.0;  ///< the sum over ties of t^3 - t
};

/// Ranks of ascending sizes; equal ones share the mean of theirs.
Ranks midranks(const std::vector<double>& sizes) {
  Ranks ranks;
  for (std::size_t begin = 0; begin < sizes.size();) {
    std::size_t end = begin + 1;
    while (end < sizes.size() && sizes[end] - sizes[begin] <= kNoise) ++end;
    const double count = static_cast<double>(end - begin);
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    ranks.rank.insert(ranks.rank.end(), end - begin, rank);
    ranks.tie_correction += count * count * count - count;
    begin = end;
  }
  return ranks;
}

/// The probability of a sum of the positive ones up to `sum`, each of these ranks being positive or
/// not with equal chances. Ranks and sum are doubled: midranks of ties are halves.
double probability_up_to(std::size_t sum, const std::vector<std::size_t>& doubled_ranks) {
  std::vector<double> probability(doubled_ranks.size() * (doubled_ranks.size() + 1) + 1, 0.0);
  probability[0] = 1.0;
  for (const std::size_t rank : doubled_ranks) {
    for (std::size_t i = probability.size(); i-- > 0;) {
      const double with = i >= rank ? probability[i - rank] : 0.0;
      probability[i] = 0.5 * (probability[i] + with);
    }
  }
  double total = 0.0;
  for (std::size_t i = 0; i <= sum; ++i) total += probability[i];
  return total;
}

double exact_p(double lesser_rank_sum, const std::vector<double>& ranks) {
  std::vector<std::size_t> doubled_ranks;
  for (const double rank : ranks) doubled_ranks.push_back(static_cast<std::size_t>(2.0 * rank));
  const auto sum = static_cast<std::size_t>(2.0 * lesser_rank_sum);
  return std::min(1.0, 2.0 * probability_up_to(sum, doubled_ranks));
}

double approximate_p(double lesser_rank_sum, std::size_t pairs, double tie_correction) {
  const double n = static_cast<double>(pairs);
  const double mean = n * (n + 1.0) / 4.0;
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - tie_correction / 48.0;
  const double z = (lesser_rank_sum - mean) / std::sqrt(variance);
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

}  // namespace

SignedRankTest signed_rank_test(const std::vector<double>& differences) {
  constexpr std::size_t kMostExactPairs = 50;
  std::vector<double> ordered;
  for (const double difference : differences) {
    if (std::abs(difference) > kNoise) ordered.push_back(difference);
  }
  std::ranges::sort(ordered, {}, [](double value) { return std::abs(value); });
  std::vector<double> sizes;
  for (const double difference : ordered) sizes.push_back(std::abs(difference));
  const Ranks ranks = midranks(sizes);

  SignedRankTest test{.pairs = ordered.size(), .zeros = differences.size() - ordered.size()};
  if (test.pairs == 0) return test;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    (ordered[i] > 0.0 ? test.rank_sum_above : test.rank_sum_below) += ranks.rank[i];
  }
  const double lesser = std::min(test.rank_sum_above, test.rank_sum_below);
  test.is_exact = test.pairs <= kMostExactPairs;
  test.p = test.is_exact ? exact_p(lesser, ranks.rank)
                         : approximate_p(lesser, test.pairs, ranks.tie_correction);
  test.rank_biserial =
      (test.rank_sum_above - test.rank_sum_below) / (test.rank_sum_above + test.rank_sum_below);
  return test;
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isnan(p[i])) order.push_back(i);
  }
  std::ranges::sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected = p;
  double greatest = 0.0;
  for (std::size_t step = 0; step < order.size(); ++step) {
    const double scaled = static_cast<double>(order.size() - step) * p[order[step]];
    greatest = std::max(greatest, std::min(1.0, scaled));
    corrected[order[step]] = greatest;
  }
  return corrected;
}

}  // namespace nbvopt
