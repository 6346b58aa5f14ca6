// The paper's numbers agree with each other, so that none is mistyped.
#include "reproduction/paper_tables.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace nbvopt {
namespace {

constexpr double kHalfDigit = 0.5;      // of a whole number, as printed
constexpr double kHalfPercent = 0.005;  // of a percentage with two digits

/// Expects that a printed percentage is that of two printed whole numbers.
void expect_percent(double printed, double value, double base) {
  const double ratio = value / base;
  const double slack = kHalfPercent + 100.0 * kHalfDigit * (1.0 + ratio) / base;
  EXPECT_NEAR(printed, 100.0 * (ratio - 1.0), slack + 1e-9) << value << " against " << base;
}

void expect_rate(double printed, double value, double duration_s) {
  const double rate = value / duration_s;
  const double slack = kHalfDigit + (1.0 + rate) * kHalfDigit / (duration_s - kHalfDigit);
  EXPECT_NEAR(printed, rate, slack) << value << " in " << duration_s << " s";
}

TEST(PaperTables, HoldSixEnvironmentsInTheirOrder) {
  std::vector<std::string_view> names;
  for (const PaperEnvironment& environment : paper_tables()) names.push_back(environment.name);
  EXPECT_THAT(names, testing::ElementsAre("simple house", "apartment", "bookstore", "cafe",
                                          "warehouse", "willowgarage"));
}

TEST(PaperTables, AgreeWithThemselves) {
  for (const PaperEnvironment& environment : paper_tables()) {
    SCOPED_TRACE(environment.name);
    const PaperFigures& planar = environment.planar;
    std::vector<PaperFigures> rows(environment.optimised.begin(), environment.optimised.end());
    for (const PaperFigures& row : rows) EXPECT_EQ(row.duration_s, planar.duration_s);
    rows.push_back(planar);
    rows.push_back(environment.spatial);
    for (const PaperFigures& row : rows) {
      SCOPED_TRACE(row.voxels);
      expect_percent(row.voxels_percent, row.voxels, planar.voxels);
      EXPECT_NEAR(row.gain, row.information - planar.information, 1.0);
      expect_percent(row.gain_percent, row.information, planar.information);
      expect_percent(row.time_percent, row.duration_s, planar.duration_s);
      expect_rate(row.voxels_per_s, row.voxels, row.duration_s);
      expect_rate(row.information_per_s, row.information, row.duration_s);
    }
  }
}

}  // namespace
}  // namespace nbvopt
