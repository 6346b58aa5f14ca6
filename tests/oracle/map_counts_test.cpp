// The counts of the shared maps, from their README.
#include <gtest/gtest.h>

#include "nbvopt/map/map_file.hpp"
#include "support/oracle.hpp"

namespace nbvopt {
namespace {

struct Known {
  const char* file;
  std::uint64_t occupied, free, certain;
  double information;
};

class MapCountsOracle : public ::testing::TestWithParam<Known> {};

TEST_P(MapCountsOracle, AreThoseOfTheReadme) {
  NBVOPT_REQUIRE_SHARED();
  const Known& known = GetParam();
  const MapCounts counts = read_map(test::shared_dir() / "maps" / known.file).counts();
  EXPECT_EQ(counts.occupied_voxels, known.occupied);
  EXPECT_EQ(counts.free_voxels, known.free);
  EXPECT_EQ(counts.certain_voxels, known.certain);
  EXPECT_NEAR(counts.information, known.information, 0.05);
}

INSTANTIATE_TEST_SUITE_P(
    Maps, MapCountsOracle,
    ::testing::Values(Known{"ASLAM_lab.bt", 178658, 2767691, 0, 0.0},
                      Known{"apartment_partial.ot", 15128, 154312, 10631, 5017.4},
                      Known{"warehouse_partial.ot", 10748, 134976, 6816, 3210.9}));

}  // namespace
}  // namespace nbvopt
