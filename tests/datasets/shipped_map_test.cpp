// The map that ships is the one that its generator makes.
#include <gtest/gtest.h>

#include "nbvopt/map/map_file.hpp"
#include "office_partial.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

TEST(OfficePartial, IsWhatItsGeneratorMakes) {
  const UncertaintyMap shipped = read_map(test::datasets_dir() / "office_partial.ot");
  const UncertaintyMap made = make_office_partial();
  ASSERT_EQ(shipped.resolution_m(), made.resolution_m());
  ASSERT_EQ(shipped.known_box(), made.known_box());
  const KeyBox box = *made.known_box();
  std::uint64_t other_state = 0;
  std::uint64_t other_uncertainty = 0;
  for (std::uint16_t x = box.min.x; x <= box.max.x; ++x) {
    for (std::uint16_t y = box.min.y; y <= box.max.y; ++y) {
      for (std::uint16_t z = box.min.z; z <= box.max.z; ++z) {
        const VoxelRecord a = shipped.at({x, y, z});
        const VoxelRecord b = made.at({x, y, z});
        other_state += a.state != b.state;
        other_uncertainty += std::abs(a.uncertainty - b.uncertainty) > 1e-5F;
      }
    }
  }
  EXPECT_EQ(other_state, 0U);
  EXPECT_EQ(other_uncertainty, 0U);
}

TEST(OfficePartial, HasKnownUnknownAndBadlySeenParts) {
  const UncertaintyMap map = read_map(test::datasets_dir() / "office_partial.ot");
  EXPECT_TRUE(map.carries_uncertainty());
  const auto at = [&](double x, double y, double z) {
    return map.at(map.lattice().key({x, y, z}));
  };
  EXPECT_EQ(at(1.93, 2.0, 0.4).state, VoxelState::free);     // where the robot drove
  EXPECT_EQ(at(6.5, 5.0, 0.4).state, VoxelState::unknown);   // the room it never entered
  EXPECT_EQ(at(2.5, 5.98, 0.5).state, VoxelState::unknown);  // inside a wall
}

}  // namespace
}  // namespace nbvopt
