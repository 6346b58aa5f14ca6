// The counts of the maps with known answers: of the shared ones from their README, of the one that
// ships from its known answers.
#include <gtest/gtest.h>

#include "nbvopt/map/map_file.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

struct KnownCounts {
  const char* file;
  std::uint64_t occupied, free, certain;
  double information;
};

MapCounts counts_of(const std::string& file) {
  return read_map(test::known_map_file(file)).counts();
}

class MapCountsOracle : public ::testing::TestWithParam<KnownCounts> {};

TEST_P(MapCountsOracle, AreThoseOfTheReadme) {
  NBVOPT_REQUIRE_SHARED();
  const KnownCounts& known = GetParam();
  const MapCounts counts = counts_of(known.file);
  EXPECT_EQ(counts.occupied_voxels, known.occupied);
  EXPECT_EQ(counts.free_voxels, known.free);
  EXPECT_EQ(counts.certain_voxels, known.certain);
  EXPECT_NEAR(counts.information, known.information, 0.05);
}

TEST(MapCountsOracle, OfTheMapThatShips) {
  const nlohmann::json oracle = test::read_oracle("office_partial.json");
  const nlohmann::json& known = oracle.at("counts");
  const MapCounts counts = counts_of(oracle.at("map"));
  EXPECT_EQ(counts.occupied_voxels, known.at("occupied"));
  EXPECT_EQ(counts.free_voxels, known.at("free"));
  EXPECT_EQ(counts.certain_voxels, known.at("certain"));
  EXPECT_NEAR(counts.information, known.at("information"), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Maps, MapCountsOracle,
    ::testing::Values(KnownCounts{"ASLAM_lab.bt", 178658, 2767691, 0, 0.0},
                      KnownCounts{"apartment_partial.ot", 15128, 154312, 10631, 5017.4},
                      KnownCounts{"warehouse_partial.ot", 10748, 134976, 6816, 3210.9}));

}  // namespace
}  // namespace nbvopt
