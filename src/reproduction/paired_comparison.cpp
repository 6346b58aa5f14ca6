#include "reproduction/paired_comparison.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <variant>

#include "report/signed_rank.hpp"

namespace nbvopt {
namespace {

using Origin = std::tuple<const ExperimentEnvironment*, std::size_t, std::uint64_t>;

/// The information that a test's episodes end with.
struct Test {
  std::string name;
  double motion_time_s = 0.0;
  bool is_auto = false;
  std::map<Origin, double> information = {};
};

std::vector<Test> tests_of(std::span<const Unit> units, std::span<const UnitResult> results) {
  std::vector<Test> tests;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto* setting = std::get_if<EpisodeSetting>(&units[i].simulation.setting);
    if (setting == nullptr || !results[i].episode) continue;
    const std::string name = test_name(*setting, units[i].explorer);
    auto test = std::ranges::find_if(tests, [&](const Test& known) {
      return known.name == name && known.motion_time_s == setting->motion_time_s;
    });
    if (test == tests.end()) {
      test = tests.insert(tests.end(), {name, setting->motion_time_s, setting->mode == "auto"});
    }
    test->information[{units[i].environment, units[i].start, units[i].simulation.seed}] =
        results[i].episode->summary.information;
  }
  return tests;
}

/// How much more than the other a test knows at the end, for each start and seed that both have.
std::vector<double> percentages(const Test& test, const Test& other) {
  std::vector<double> percents;
  for (const auto& [origin, information] : test.information) {
    const auto found = other.information.find(origin);
    if (found == other.information.end() || !(found->second > 0.0)) continue;
    percents.push_back(100.0 * (information / found->second - 1.0));
  }
  return percents;
}

PairedComparison compare(const Test& test, const Test& other, const std::vector<double>& percents) {
  const auto [least, most] = std::ranges::minmax(percents);
  const auto is_better = [](double percent) { return percent > 0.0; };
  return {.test = test.name,
          .other = other.name,
          .motion_time_s = test.motion_time_s,
          .pairs = percents.size(),
          .better = static_cast<std::size_t>(std::ranges::count_if(percents, is_better)),
          .mean_percent = std::accumulate(percents.begin(), percents.end(), 0.0) /
                          static_cast<double>(percents.size()),
          .least_percent = least,
          .most_percent = most,
          .p = signed_rank_test(percents).p};
}

}  // namespace

std::vector<PairedComparison> compare_tests(std::span<const Unit> units,
                                            std::span<const UnitResult> results) {
  const std::vector<Test> tests = tests_of(units, results);
  std::vector<PairedComparison> comparisons;
  std::vector<double> p;
  for (const Test& test : tests) {
    for (const Test& other : tests) {
      const bool is_asked =
          test.is_auto && other.motion_time_s == test.motion_time_s && other.name != test.name;
      const std::vector<double> percents =
          is_asked ? percentages(test, other) : std::vector<double>{};
      if (percents.empty()) continue;
      comparisons.push_back(compare(test, other, percents));
      p.push_back(comparisons.back().p);
    }
  }
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < comparisons.size(); ++i) comparisons[i].holm_p = corrected[i];
  return comparisons;
}

}  // namespace nbvopt
