#include "study/evaluate/interval.hpp"

#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "core/uniform.hpp"
#include "study/evaluate/summary.hpp"

namespace nbvopt::study {
namespace {

constexpr int kDraws = 1000;
constexpr double kTail = 0.025;

struct Sum {
  double values = 0.0;
  double count = 0.0;

  void operator+=(const Sum& other) {
    values += other.values;
    count += other.count;
  }
};

/// [map][start]
std::vector<std::vector<Sum>> clustered(const std::vector<CaseValue>& values) {
  std::map<std::string, std::map<std::size_t, Sum>> by_name;
  for (const CaseValue& one : values) by_name[one.of->map][one.of->start] += Sum{one.value, 1.0};
  std::vector<std::vector<Sum>> maps;
  for (const auto& [name, starts] : by_name) {
    maps.emplace_back();
    for (const auto& [start, sum] : starts) maps.back().push_back(sum);
  }
  return maps;
}

template <class Cluster>
const Cluster& drawn(const std::vector<Cluster>& clusters, std::mt19937_64& generator) {
  return clusters[static_cast<std::size_t>(uniform(generator) *
                                           static_cast<double>(clusters.size()))];
}

}  // namespace

std::vector<double> values_of(const std::vector<CaseValue>& values) {
  std::vector<double> numbers;
  for (const CaseValue& one : values) numbers.push_back(one.value);
  return numbers;
}

Interval mean_interval(const std::vector<CaseValue>& values) {
  if (values.empty()) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    return {kUnknown, kUnknown};
  }
  const std::vector<std::vector<Sum>> maps = clustered(values);
  std::mt19937_64 generator(1);
  std::vector<double> means;
  for (int draw = 0; draw < kDraws; ++draw) {
    Sum sum;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const std::vector<Sum>& starts = drawn(maps, generator);
      for (std::size_t j = 0; j < starts.size(); ++j) sum += drawn(starts, generator);
    }
    means.push_back(sum.values / sum.count);
  }
  return {quantile(means, kTail), quantile(means, 1.0 - kTail)};
}

}  // namespace nbvopt::study
