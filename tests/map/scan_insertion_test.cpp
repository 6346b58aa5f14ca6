#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "map/map_access.hpp"
#include "map/scan_rays.hpp"
#include "map/scan_uncertainty.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"
#include "support/camera_pose.hpp"
#include "support/error_message.hpp"
#include "support/made_map.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kInfinity;
using test::kNaN;
using ::testing::HasSubstr;

// OctoMap's defaults: what one hit and one miss add, in log-odds, and where they stop.
const float kHitLogOdds = std::log(0.7F / 0.3F);
const float kMissLogOdds = std::log(0.4F / 0.6F);
const float kMinLogOdds = std::log(0.1192F / 0.8808F);
const float kMaxLogOdds = std::log(0.971F / 0.029F);

/// The camera stands in the middle of a voxel and looks along map x.
Transform looking_along_x(const Eigen::Vector3d& position_m = {0.05, 0.05, 0.05}) {
  return test::camera_at(position_m);
}

/// The voxel `steps` voxels along x from the one of looking_along_x(), at 0.1 m.
VoxelKey ahead(int steps) { return {static_cast<std::uint16_t>(32768 + steps), 32768, 32768}; }

Scan points(std::vector<Eigen::Vector3f> points_m) {
  Scan scan;
  scan.points_m = std::move(points_m);
  return scan;
}

Scan no_returns(std::vector<Eigen::Vector3f> directions) {
  Scan scan;
  scan.no_returns = std::move(directions);
  return scan;
}

InsertResult insert(UncertaintyMap& map, const Scan& scan, const SensorOptions& sensor = {}) {
  return insert_scan(map, scan, looking_along_x(), sensor);
}

using Record = std::tuple<VoxelState, float>;

/// State and u of every known voxel, by packed key.
std::map<std::uint64_t, Record> records(const UncertaintyMap& map) {
  std::map<std::uint64_t, Record> all;
  const auto box = map.known_box();
  if (!box) return all;
  for (int x = box->min.x; x <= box->max.x; ++x) {
    for (int y = box->min.y; y <= box->max.y; ++y) {
      for (int z = box->min.z; z <= box->max.z; ++z) {
        const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                           static_cast<std::uint16_t>(z)};
        const VoxelRecord record = map.at(key);
        if (record.state != VoxelState::unknown) {
          all[packed(key)] = {record.state, record.uncertainty};
        }
      }
    }
  }
  return all;
}

/// A scan of an uneven wall, with colours, near points, far points and no-returns.
Scan random_scan(unsigned seed, int rays) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> tangent(-0.5F, 0.5F);
  std::uniform_real_distribution<float> depth_m(0.3F, 5.0F);
  Scan scan;
  for (int i = 0; i < rays; ++i) {
    const Eigen::Vector3f direction(tangent(random), tangent(random), 1.0F);
    if (i % 10 == 0) {
      scan.no_returns.push_back(direction);
    } else {
      scan.points_m.push_back(direction * depth_m(random));
      scan.colours.push_back({static_cast<std::uint8_t>(random()), 2, 3});
    }
  }
  return scan;
}

TEST(InsertScan, ClearsTheRayAndOccupiesItsEnd) {
  UncertaintyMap map(0.1);
  const InsertResult result = insert(map, points({{0, 0, 1}}));
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(map.at(ahead(i)).state, VoxelState::free) << i;
    EXPECT_FLOAT_EQ(map.at(ahead(i)).log_odds, kMissLogOdds) << i;
    EXPECT_EQ(map.at(ahead(i)).uncertainty, 1.0F) << i;
  }
  EXPECT_EQ(map.at(ahead(10)).state, VoxelState::occupied);
  EXPECT_FLOAT_EQ(map.at(ahead(10)).log_odds, kHitLogOdds);
  EXPECT_EQ(map.at(ahead(11)).state, VoxelState::unknown);
  EXPECT_EQ(map.at(ahead(-1)).state, VoxelState::unknown);
  EXPECT_EQ(map.counts().free_voxels, 10U);
  EXPECT_EQ(map.counts().occupied_voxels, 1U);
  EXPECT_EQ(result.points_used, 1U);
  EXPECT_EQ(result.changes.size(), 11U);
}

/// Equation (9): at the focal distance, in the middle of the image, u is 0; the voxel's other
/// point is 0.04 m further. Its first observation counts, and so does every point.
TEST(InsertScan, KeepsTheLeastUncertaintyOfAllPoints) {
  const double u_far = 0.5 * (1.0 - 2.0 / (1.0 + std::exp(0.04)));  // Equations (2), (8)
  UncertaintyMap map(0.1);
  insert(map, points({{0, 0, 1.04F}}));
  EXPECT_NEAR(map.at(ahead(10)).uncertainty, u_far, 1e-6);
  insert(map, points({{0, 0, 1}}));
  EXPECT_EQ(map.at(ahead(10)).uncertainty, 0.0F);
  const InsertResult worse = insert(map, points({{0, 0, 1.04F}}));
  EXPECT_EQ(map.at(ahead(10)).uncertainty, 0.0F);
  EXPECT_TRUE(worse.changes.empty());

  for (const auto& scan :
       {points({{0, 0, 1.04F}, {0, 0, 1}, {0, 0, 1.04F}}), points({{0, 0, 1}, {0, 0, 1.04F}})}) {
    UncertaintyMap other(0.1);
    insert(other, scan);
    EXPECT_EQ(other.at(ahead(10)).uncertainty, 0.0F);
    EXPECT_FLOAT_EQ(other.at(ahead(10)).log_odds, kHitLogOdds) << "one hit a scan";
  }
}

/// Equation (9) over a wall's points, most of which are passed over by a bound.
TEST(InsertScan, KeepsTheLeastUncertaintyOfManyPoints) {
  for (const double normal_weight : {0.0, 0.3}) {
    SensorOptions sensor;
    sensor.normal_weight = normal_weight;
    UncertaintyMap map(0.25);
    const Scan scan = random_scan(3, 20000);
    const Transform T_map_sensor = looking_along_x({0.33, -0.21, 0.57});
    insert_scan(map, scan, T_map_sensor, sensor);

    const ScanUncertainty uncertainty(scan, T_map_sensor, sensor, map.lattice());
    std::map<std::uint64_t, float> least;
    for (const ScanHit& hit : scan_rays(scan, T_map_sensor, sensor, map.lattice()).hits) {
      float& least_u = least.try_emplace(packed(hit.key), 1.0F).first->second;
      least_u = std::min(least_u, uncertainty.of(hit));
    }
    std::map<std::uint64_t, float> kept;
    for (const auto& [key, record] : records(map)) {
      if (std::get<VoxelState>(record) == VoxelState::occupied) kept[key] = std::get<float>(record);
    }
    EXPECT_EQ(kept, least);
    EXPECT_GT(least.size(), 300U);
  }
}

TEST(InsertScan, UsesTheSensorsUncertaintyModel) {
  SensorOptions sensor;
  sensor.uncertainty_mode = UncertaintyMode::angle;
  const Eigen::Vector3f p_sensor_m(0.31F, -0.22F, 1.37F);
  UncertaintyMap map(0.1);
  insert(map, points({p_sensor_m}), sensor);
  const Eigen::Vector3d p_map_m = looking_along_x() * p_sensor_m.cast<double>();
  EXPECT_FLOAT_EQ(map.at(map.lattice().key(p_map_m)).uncertainty,
                  UncertaintyModel(sensor).uncertainty(p_sensor_m.cast<double>()));
}

TEST(InsertScan, LetsOccupiedWinOverFreeWithinAScan) {
  UncertaintyMap map(0.1);
  insert(map, points({{0, 0, 2}, {0, 0, 1}}));
  EXPECT_FLOAT_EQ(map.at(ahead(10)).log_odds, kHitLogOdds);
  EXPECT_EQ(map.at(ahead(15)).state, VoxelState::free);
  EXPECT_EQ(map.at(ahead(20)).state, VoxelState::occupied);
}

TEST(InsertScan, ForgetsTheUncertaintyAndColourOfWhatBecomesFree) {
  UncertaintyMap map(0.1);
  Scan scan = points({{0, 0, 1}});
  scan.colours = {{10, 20, 30}};
  insert(map, scan);
  insert(map, points({{0, 0, 2}}));
  insert(map, points({{0, 0, 2}}));
  EXPECT_EQ(map.at(ahead(10)).state, VoxelState::occupied) << "one hit weighs more than 2 misses";
  EXPECT_EQ(map.at(ahead(10)).uncertainty, 0.0F);
  const InsertResult result = insert(map, points({{0, 0, 2}}));
  EXPECT_EQ(map.at(ahead(10)).state, VoxelState::free);
  EXPECT_EQ(map.at(ahead(10)).uncertainty, 1.0F);
  EXPECT_EQ(map.at(ahead(10)).colour, (std::array<std::uint8_t, 3>{255, 255, 255}));
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].key, ahead(10));
  EXPECT_EQ(result.changes[0].state, VoxelState::free);
  EXPECT_EQ(result.changes[0].uncertainty, 1.0F);
}

TEST(InsertScan, StaysWithinOctoMapsClampingThresholds) {
  UncertaintyMap map(0.1);
  for (int i = 0; i < 20; ++i) insert(map, points({{0, 0, 1}}));
  EXPECT_FLOAT_EQ(map.at(ahead(10)).log_odds, kMaxLogOdds);
  EXPECT_FLOAT_EQ(map.at(ahead(5)).log_odds, kMinLogOdds);
}

TEST(InsertScan, ClearsToDMaxWhereNothingReturns) {
  UncertaintyMap map(0.1);
  const InsertResult result = insert(map, no_returns({{0, 0, 0.001F}}));
  for (int i = 0; i <= 40; ++i) EXPECT_EQ(map.at(ahead(i)).state, VoxelState::free) << i;
  EXPECT_EQ(map.at(ahead(41)).state, VoxelState::unknown);
  EXPECT_EQ(map.counts().free_voxels, 41U);
  EXPECT_EQ(result.rays_cleared, 1U);
  EXPECT_EQ(result.changes.size(), 41U);
}

TEST(InsertScan, TakesAReturnAtOrBeyondDMaxForNone) {
  for (const float depth_m : {4.0F, 4.01F, 100.0F}) {
    UncertaintyMap map(0.1);
    const InsertResult result = insert(map, points({{0, 0, depth_m}}));
    EXPECT_EQ(map.counts().free_voxels, 41U) << depth_m;
    EXPECT_EQ(map.counts().occupied_voxels, 0U) << depth_m;
    EXPECT_EQ(result.rays_cleared, 1U);
    EXPECT_EQ(result.points_used, 0U);
  }
}

TEST(InsertScan, IgnoresNoReturnsWhenToldTo) {
  SensorOptions sensor;
  sensor.no_return = NoReturn::ignore;
  UncertaintyMap map(0.1);
  Scan scan = points({{0, 0, 5}, {0, 0, 1}});
  scan.no_returns = {{0, 0.1F, 1}};
  const InsertResult result = insert(map, scan, sensor);
  EXPECT_EQ(result.rays_cleared, 0U);
  EXPECT_EQ(map.counts().free_voxels, 10U);
}

TEST(InsertScan, IgnoresWhatIsNear) {
  UncertaintyMap map(0.1);
  const InsertResult result = insert(map, points({{0, 0, 0.5F}, {0, 0, 0.1F}, {0, 0, 0}}));
  EXPECT_EQ(result.points_ignored, 3U);
  EXPECT_TRUE(result.changes.empty());
  EXPECT_EQ(map.known_box(), std::nullopt);
}

TEST(InsertScan, IgnoresWhatIsNotFinite) {
  UncertaintyMap map(0.1);
  Scan scan = points({{0, 0, kNaN}, {kNaN, 0, 1}, {0, 0, kInfinity}, {0, 0, -kInfinity}});
  scan.no_returns = {{0, 0, 0}, {0, 0, kNaN}, {kInfinity, 0, 1}};
  const InsertResult result = insert(map, scan);
  EXPECT_EQ(result.points_ignored, 7U);
  EXPECT_EQ(result.rays_cleared, 0U);
  EXPECT_EQ(map.known_box(), std::nullopt);
}

TEST(InsertScan, TellsApartWhatItDoesNotUse) {
  UncertaintyMap map(0.1);
  Scan scan = points({{0, 0, 1}, {0, 0, 0.5F}, {0, 0, 0}, {0, 0, 4}, {0, 0, 9}, {0, 0, kNaN}});
  scan.no_returns = {{0, 0, 1}, {0, 0, 0}};
  const auto expect_counts = [](const ScanCounts& counts) {
    EXPECT_EQ(counts.points_used, 1U);
    EXPECT_EQ(counts.points_too_near, 2U);
    EXPECT_EQ(counts.points_too_far, 2U);
    EXPECT_EQ(counts.no_returns, 1U);
    EXPECT_EQ(counts.points_not_finite, 2U);
    EXPECT_EQ(counts.points_off_lattice, 0U);
    EXPECT_EQ(counts.nearest_m, 0.5) << "the origin is no point";
    EXPECT_EQ(counts.farthest_m, 9.0);
  };
  expect_counts(insert(map, scan));
  expect_counts(count_scan(scan, {}));
  SensorOptions ignoring;
  ignoring.no_return = NoReturn::ignore;
  expect_counts(insert(map, scan, ignoring));
}

TEST(InsertScan, RefusesAScanOfWhichAllIsImplausiblyFar) {
  UncertaintyMap map(0.1);
  insert(map, points({{0, 0, 1}}));
  Scan millimetres = points({{0, 0, 1000}, {0, 100, 1000}, {0, 0, 0}});
  millimetres.no_returns = {{0, 0, 1}};
  EXPECT_THAT(test::message_of<InputError>([&] { insert(map, millimetres); }),
              HasSubstr("millimetres"));
  EXPECT_EQ(map.at(ahead(10)).state, VoxelState::occupied);
  millimetres.points_m.push_back({0, 0, 2});
  EXPECT_EQ(insert(map, millimetres).points_used, 1U);
}

TEST(NoneInRange, NamesTheLikelyCause) {
  const auto doubt = [](const Scan& scan) { return none_in_range(count_scan(scan, {}), {}); };
  EXPECT_EQ(doubt(points({{0, 0, 1}, {0, 0, 1000}})), "");
  EXPECT_EQ(doubt(points({{0, 0, 1000}, {0, 0, 0.25F}})),
            "no point is between 0.5 and 4 m away: 1 nearer, 1 farther, from 0.25 to 1000 m; are "
            "they millimetres, or is depth_scale_m wrong?");
  EXPECT_THAT(doubt(points({{0, 0, 120}})), HasSubstr("centimetres"));
  EXPECT_THAT(doubt(points({{0, 0, 5}, {0, 0, 20}})), HasSubstr("not in the map's"));
  EXPECT_THAT(doubt(points({{0, 0, 0.001F}})), HasSubstr("1 nearer"));
  EXPECT_THAT(doubt(points({{0, 0, 0}})), HasSubstr("origin"));
  EXPECT_THAT(doubt(points({{0, 0, kNaN}})), HasSubstr("finite"));
  EXPECT_THAT(doubt(no_returns({{0, 0, 1}})), HasSubstr("largest value"));
  EXPECT_THAT(doubt({}), HasSubstr("no points"));
}

TEST(InsertScan, MeasuresTheRangeAlongTheAxisOfTheSensor) {
  const Scan scan = points({{2.0F, 0, 3.8F}});  // 4.29 m away
  UncertaintyMap map(0.1);
  EXPECT_EQ(insert(map, scan).points_used, 0U);
  SensorOptions sensor;
  sensor.range_axis = RangeAxis::z_depth;
  EXPECT_EQ(insert(map, scan, sensor).points_used, 1U);
}

TEST(InsertScan, IgnoresPointsOffTheLattice) {
  UncertaintyMap map(0.01);
  SensorOptions sensor;
  sensor.range_max_m = 1000.0;
  const InsertResult result = insert(map, points({{0, 0, 327.605F}, {0, 0, 327.705F}}), sensor);
  EXPECT_EQ(result.points_ignored, 1U);
  EXPECT_EQ(result.points_used, 1U);
  const Eigen::Vector3d last_m = looking_along_x() * Eigen::Vector3d(0, 0, 327.605);
  EXPECT_EQ(map.at(map.lattice().key(last_m)).state, VoxelState::occupied);
}

TEST(InsertScan, RefusesAPoseThatIsNone) {
  UncertaintyMap map(0.1);
  Transform T_map_sensor = looking_along_x();
  const auto message = [&] {
    return test::message_of<InputError>([&] {
      insert_scan(map, points({{0, 0, 1}}), T_map_sensor, {});
    });
  };
  T_map_sensor.translation().x() = kNaN;
  EXPECT_THAT(message(), HasSubstr("finite"));
  T_map_sensor.translation().x() = 4000.0;
  EXPECT_THAT(message(), HasSubstr("lattice"));
  EXPECT_EQ(map.known_box(), std::nullopt);
}

TEST(InsertScan, FusesColours) {
  UncertaintyMap map(0.1);
  Scan scan = points({{0, 0, 1}, {0, 0, 1.04F}});
  scan.colours = {{10, 100, 0}, {30, 100, 1}};
  insert(map, scan);
  EXPECT_EQ(map.at(ahead(10)).colour, (std::array<std::uint8_t, 3>{20, 100, 0}));
  scan.colours = {{40, 200, 0}, {40, 200, 0}};
  insert(map, scan);
  EXPECT_EQ(map.at(ahead(10)).colour, (std::array<std::uint8_t, 3>{30, 150, 0}));
  insert(map, points({{0, 0, 1}}));
  EXPECT_EQ(map.at(ahead(10)).colour, (std::array<std::uint8_t, 3>{30, 150, 0}));
}

/// The list of changes against the whole map before and after.
TEST(InsertScan, ReturnsEveryChangeOnce) {
  UncertaintyMap map(0.2);
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const auto before = records(map);
    Transform T_map_sensor = looking_along_x({0.3, -0.2, 0.1});
    T_map_sensor.rotate(Eigen::AngleAxisd(0.2 * seed, Eigen::Vector3d::UnitY()));
    const InsertResult result = insert_scan(map, random_scan(seed, 400), T_map_sensor, {});
    const auto after = records(map);

    std::map<std::uint64_t, Record> changed;
    for (const auto& [key, record] : after) {
      const auto old = before.find(key);
      if (old == before.end() || old->second != record) changed[key] = record;
    }
    std::map<std::uint64_t, Record> told;
    for (const VoxelChange& change : result.changes) {
      const bool is_new =
          told.emplace(packed(change.key), Record{change.state, change.uncertainty}).second;
      EXPECT_TRUE(is_new);
    }
    EXPECT_EQ(told, changed);
    EXPECT_GT(changed.size(), 100U);
  }
}

/// Inner nodes and pruning after insertions are what they are after restoring the whole tree.
TEST(InsertScan, TellsWhatTheMapGained) {
  UncertaintyMap map(0.1);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const MapCounts before = map.counts();
    // Every fifth scan clears what others have made occupied.
    const InsertResult result =
        insert(map, seed % 5 == 4 ? no_returns({{0.0F, 0.0F, 1.0F}, {0.1F, 0.0F, 1.0F}})
                                  : random_scan(seed, 300));
    const MapCounts after = map.counts();
    EXPECT_NEAR(result.information_gained, after.information - before.information, 1e-9);
    EXPECT_EQ(result.certain_voxels_gained, static_cast<std::int64_t>(after.certain_voxels) -
                                                static_cast<std::int64_t>(before.certain_voxels));
  }
}

TEST(InsertScan, LeavesTheTreeInOrder) {
  UncertaintyMap map(0.1);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    insert_scan(map, random_scan(seed, 4000), looking_along_x({0.3, -0.2, 0.1}), {});
  }
  const auto inner_nodes = [&map] {
    std::vector<std::pair<float, float>> inner;
    const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
    for (auto it = tree.begin_tree(); it != tree.end_tree(); ++it) {
      if (!it.isLeaf()) inner.emplace_back(it->getLogOdds(), it->uncertainty());
    }
    return inner;
  };
  const auto before = inner_nodes();
  const std::size_t nodes = detail::MapAccess::tree(map).size();
  EXPECT_EQ(nodes, detail::MapAccess::tree(map).calcNumNodes());
  map.finish_writing();
  EXPECT_EQ(detail::MapAccess::tree(map).size(), nodes);
  EXPECT_EQ(inner_nodes(), before);
}

TEST(InsertScan, ExpandsAPrunedLeafBeforeItWrites) {
  UncertaintyMap map(0.1);
  for (std::uint16_t x = 0; x < 16; ++x) {
    for (std::uint16_t y = 0; y < 16; ++y) {
      for (std::uint16_t z = 0; z < 16; ++z) {
        map.set({static_cast<std::uint16_t>(32768 + x), static_cast<std::uint16_t>(32768 + y),
                 static_cast<std::uint16_t>(32768 + z)},
                {.log_odds = -1.0F});
      }
    }
  }
  map.finish_writing();
  ASSERT_EQ(map.counts().leaves, 1U);
  const InsertResult result = insert(map, points({{0, 0, 1}}));
  EXPECT_EQ(map.counts().free_voxels, 4096U) << "one hit does not outweigh -1";
  EXPECT_FLOAT_EQ(map.at(ahead(10)).log_odds, -1.0F + kHitLogOdds);
  EXPECT_FLOAT_EQ(map.at(ahead(9)).log_odds, -1.0F + kMissLogOdds);
  EXPECT_FLOAT_EQ(map.at(ahead(11)).log_odds, -1.0F);
  EXPECT_EQ(map.at(ahead(10)).uncertainty, 1.0F) << "a free voxel carries none";
  EXPECT_TRUE(result.changes.empty());
  insert(map, points({{0, 0, 1}}));
  EXPECT_EQ(map.at(ahead(10)).state, VoxelState::occupied);
  EXPECT_EQ(map.at(ahead(10)).uncertainty, 0.0F);
  EXPECT_EQ(map.at({32768, 32769, 32768}).state, VoxelState::free);
}

/// The ray leaves several windows behind it, and all of their tiles.
TEST(InsertScan, ClearsARayOfAThousandVoxels) {
  UncertaintyMap map(0.1);
  SensorOptions sensor;
  sensor.range_max_m = 200.0;
  insert_scan(map, points({{30.0F, -50.0F, 100.0F}}), looking_along_x({-40.0, 0.012, 0.034}),
              sensor);
  std::set<std::uint64_t> expected;
  const Eigen::Vector3d from = map.lattice().to_lattice({-40.0, 0.012, 0.034});
  const Eigen::Vector3d to = map.lattice().to_lattice({60.0, -29.988, 50.034});
  for (int i = 0; i <= 1000000; ++i) {
    const Eigen::Vector3d p = from + (to - from) * (i / 1e6);
    expected.insert(packed({static_cast<std::uint16_t>(p.x()), static_cast<std::uint16_t>(p.y()),
                            static_cast<std::uint16_t>(p.z())}));
  }
  const MapCounts counts = map.counts();
  EXPECT_EQ(counts.occupied_voxels, 1U);
  // Sampling misses only corners that the ray cuts by less than 0.2 mm.
  EXPECT_GE(counts.free_voxels + 1, expected.size());
  EXPECT_LE(counts.free_voxels + 1, expected.size() + 20);
  std::size_t missed = 0;
  for (const std::uint64_t key : expected) {
    const VoxelKey voxel{static_cast<std::uint16_t>(key), static_cast<std::uint16_t>(key >> 16),
                         static_cast<std::uint16_t>(key >> 32)};
    missed += map.at(voxel).state == VoxelState::unknown;
  }
  EXPECT_EQ(missed, 0U);
}

/// Rays into every direction of a map that other scans have filled: some 30 windows.
class ScanThatGivesUp : public ::testing::Test {
 protected:
  ScanThatGivesUp() {
    sensor.range_max_m = 60.0;
    sensor.range_axis = RangeAxis::euclidean;
    std::mt19937 random(7);
    std::normal_distribution<float> any;
    for (int i = 0; i < kRays; ++i) {
      const Eigen::Vector3f direction(any(random), any(random), any(random));
      scan.points_m.push_back(20.0F * direction);
      scan.no_returns.push_back(-direction);
    }
  }

  static InsertLimits within(std::uint64_t max_bytes) {
    InsertLimits limits;
    limits.max_bytes = max_bytes;
    return limits;
  }

  std::string bytes() const { return map_file_bytes(map, MapFormat::uncertainty_ot); }

  void insert(const InsertLimits& limits) {
    insert_scan(map, scan, looking_along_x(), sensor, limits);
  }

  static constexpr int kRays = 40;
  UncertaintyMap map{0.1};
  SensorOptions sensor;
  Scan scan;
};

TEST_F(ScanThatGivesUp, LeavesNothingOfItselfInAnEmptyMap) {
  const std::string before = bytes();
  int refused = 0;
  std::string message;
  for (std::uint64_t max_bytes = 0;; max_bytes += 20'000'000) {  // some more windows each time
    message = test::message_of<ScanTooLargeError>([&] { insert(within(max_bytes)); });
    if (message.empty()) break;
    ++refused;
    EXPECT_THAT(message, HasSubstr("lower sensor.range_max_m or take a coarser map"));
    ASSERT_EQ(bytes(), before) << max_bytes;
  }
  EXPECT_GT(refused, 3);
  EXPECT_LT(refused, 50);
  EXPECT_NE(bytes(), before);
}

TEST_F(ScanThatGivesUp, LeavesAMapAsItWas) {
  insert({});
  test::set_box(map, test::keys_between(map.lattice(), {-20.0, -10.0, -10.0}, {-17.0, 5.0, 5.0}),
                test::kFree);  // large leaves
  map.finish_writing();
  std::ranges::reverse(scan.points_m);
  scan.points_m.resize(kRays / 2);
  for (Eigen::Vector3f& direction : scan.no_returns) direction.x() += 0.3F;
  const std::string before = bytes();
  const std::size_t nodes = map.counts().nodes;
  for (std::uint64_t max_bytes = 1'000'000; max_bytes < 100'000'000; max_bytes += 24'000'000) {
    EXPECT_THROW(insert(within(max_bytes)), ScanTooLargeError) << max_bytes;
    ASSERT_EQ(bytes(), before) << max_bytes;
    EXPECT_EQ(map.counts().nodes, nodes);
  }
}

TEST_F(ScanThatGivesUp, HeedsACancellation) {
  InsertLimits limits;
  limits.cancel.cancel();
  EXPECT_THROW(insert(limits), CancelledError);
  EXPECT_FALSE(map.known_box());
  scan.points_m.resize(1);  // one window
  scan.no_returns.clear();
  EXPECT_THROW(insert(limits), CancelledError);
  EXPECT_THROW(insert(within(1000)), ScanTooLargeError);
  EXPECT_FALSE(map.known_box());
}

/// At any time, that is.
TEST_F(ScanThatGivesUp, HeedsACancellationInTheMiddle) {
  insert({});
  for (int i = 0; i < 2000; ++i) scan.no_returns.push_back(scan.no_returns[i % kRays] * 0.5F);
  std::ranges::reverse(scan.no_returns);
  const std::string before = bytes();
  int cancelled = 0;
  for (int i = 0; i < 40; ++i) {
    const InsertLimits limits;
    std::jthread canceller([&limits, i] {
      std::this_thread::sleep_for(std::chrono::microseconds(250 * i));
      limits.cancel.cancel();
    });
    try {
      insert(limits);
    } catch (const CancelledError&) {
      ++cancelled;
      ASSERT_EQ(bytes(), before);
      continue;
    }
    break;  // it was done before
  }
  EXPECT_GT(cancelled, 0);
}

/// OctoMap's own rays, computed in single precision, differ where they graze voxels.
TEST(InsertScan, ClearsAndOccupiesWhatOctoMapWould) {
  const Transform T_map_sensor = looking_along_x({0.33, -0.21, 0.57});
  const Scan scan = random_scan(11, 3000);
  SensorOptions sensor;
  sensor.range_max_m = 10.0;
  UncertaintyMap map(0.1);
  insert_scan(map, points(scan.points_m), T_map_sensor, sensor);

  octomap::OcTree tree(0.1);
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& p : scan.points_m) {
    if (p.norm() <= sensor.range_min_m) continue;
    const Eigen::Vector3d p_map_m = T_map_sensor * p.cast<double>();
    cloud.push_back(static_cast<float>(p_map_m.x()), static_cast<float>(p_map_m.y()),
                    static_cast<float>(p_map_m.z()));
  }
  octomap::KeySet free_keys;
  octomap::KeySet occupied_keys;
  tree.computeUpdate(cloud, octomap::point3d(0.33F, -0.21F, 0.57F), free_keys, occupied_keys, -1);

  std::size_t agree = 0;
  const auto count = [&](const octomap::KeySet& keys, VoxelState state) {
    for (const octomap::OcTreeKey& key : keys) {
      agree += map.at({key[0], key[1], key[2]}).state == state;
    }
  };
  count(free_keys, VoxelState::free);
  count(occupied_keys, VoxelState::occupied);
  const MapCounts counts = map.counts();
  const std::size_t ours = counts.free_voxels + counts.occupied_voxels;
  const std::size_t theirs = free_keys.size() + occupied_keys.size();
  EXPECT_EQ(counts.occupied_voxels, occupied_keys.size());
  EXPECT_GT(theirs, 10000U);
  EXPECT_LT(ours - agree, ours / 1000);
  EXPECT_LT(theirs - agree, theirs / 1000);
}

TEST(InsertScan, GivesTheSameAnswerForTheSameScan) {
  const auto changes = [] {
    UncertaintyMap map(0.1);
    std::vector<std::tuple<std::uint64_t, VoxelState, float>> all;
    for (unsigned seed = 1; seed <= 3; ++seed) {
      for (const VoxelChange& change : insert(map, random_scan(seed, 500)).changes) {
        all.emplace_back(packed(change.key), change.state, change.uncertainty);
      }
    }
    return all;
  };
  EXPECT_EQ(changes(), changes());
}

}  // namespace
}  // namespace nbvopt
