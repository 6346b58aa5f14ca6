#include "map/map_image.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "support/camera_pose.hpp"
#include "support/made_map.hpp"

namespace nbvopt {
namespace {

std::string file_of(const UncertaintyMap& map) {
  return map_file_bytes(map, MapFormat::uncertainty_ot);
}

/// Rays of all lengths into all directions, through some tiles.
Scan scan_around(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> any;
  Scan scan;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3f direction(any(random), any(random), any(random));
    if (i % 4 == 0) {
      scan.no_returns.push_back(direction);
    } else {
      scan.points_m.push_back(direction);
    }
  }
  return scan;
}

class MapImageTest : public ::testing::Test {
 protected:
  MapImageTest() {
    sensor.range_axis = RangeAxis::euclidean;
    sensor.range_max_m = 4.0;
  }

  InsertResult insert(unsigned seed) {
    const double along_m = seed % 7;
    return insert_scan(map, scan_around(seed), test::camera_at({along_m, 0.0, 0.0}), sensor);
  }

  UncertaintyMap map{0.05};
  SensorOptions sensor;
  HeldBytes all;
  MapImage image{all};
};

TEST_F(MapImageTest, IsTheFileOfTheMapAsItGrows) {
  EXPECT_EQ(image.file(map).joined(), file_of(map)) << "empty";
  for (unsigned seed = 0; seed < 20; ++seed) {
    image.forget(insert(seed).tiles);
    ASSERT_EQ(image.file(map).joined(), file_of(map)) << seed;
  }
}

TEST_F(MapImageTest, KnowsLeavesThatAreLargerThanATile) {
  constexpr std::uint16_t kLast = 32768 + 127;
  test::set_box(map, {{32768, 32768, 32768}, {kLast, kLast, kLast}}, test::kFree);
  map.finish_writing();
  ASSERT_EQ(map.counts().leaves, 1U);
  EXPECT_TRUE(image.missing(map).empty());
  EXPECT_EQ(image.file(map).joined(), file_of(map));
  image.forget(insert(0).tiles);  // splits it
  EXPECT_GE(image.missing(map).size(), 8U);
  EXPECT_EQ(image.file(map).joined(), file_of(map));
}

TEST_F(MapImageTest, CopiesWhatHasChangedOnly) {
  for (unsigned seed = 0; seed < 7; ++seed) insert(seed);
  const SharedBytes before = image.file(map);
  EXPECT_TRUE(image.missing(map).empty());
  Scan ahead;
  ahead.points_m = {{0.0F, 0.0F, 1.0F}};
  const InsertResult inserted = insert_scan(map, ahead, test::camera_at({0.0, 0.0, 0.0}), sensor);
  image.forget(inserted.tiles);
  EXPECT_EQ(image.missing(map).size(), inserted.tiles.size());
  EXPECT_LE(inserted.tiles.size(), 4U);
  for (const VoxelKey& tile : image.missing(map)) image.copy(map, tile);
  EXPECT_TRUE(image.missing(map).empty());
  const SharedBytes after = image.file(map);
  const std::set<SharedBytes::Piece> old(before.pieces().begin(), before.pieces().end());
  std::size_t fresh_bytes = 0;
  for (const auto& piece : after.pieces()) {
    if (!old.contains(piece)) fresh_bytes += piece->size();
  }
  EXPECT_LT(fresh_bytes, after.size() / 2);
  EXPECT_EQ(after.joined(), file_of(map));
  image.copy(map, {0, 0, 0});  // not in the map
  EXPECT_EQ(image.file(map).joined(), file_of(map));
}

TEST_F(MapImageTest, CountsWhatAnybodyHolds) {
  insert(1);
  std::uint64_t one = 0;
  {
    const SharedBytes held = image.file(map);
    one = all.bytes();
    EXPECT_GT(one, held.size() * 9 / 10);
    EXPECT_LT(one, held.size() * 11 / 10);
    EXPECT_EQ(image.bytes(), one);
    image.forget_all();
    EXPECT_EQ(image.bytes(), 0U);
    EXPECT_EQ(all.bytes(), one) << "a reader has them";
    EXPECT_EQ(image.file(map).joined(), held.joined());
    EXPECT_EQ(all.bytes(), 2 * one);
    EXPECT_EQ(image.bytes(), one);
  }
  EXPECT_EQ(all.bytes(), one);
  image.forget(insert(1).tiles);
  EXPECT_LT(image.bytes(), one);
  EXPECT_EQ(all.bytes(), image.bytes());
  image.forget_all();
  EXPECT_EQ(all.bytes(), 0U);
}

}  // namespace
}  // namespace nbvopt
