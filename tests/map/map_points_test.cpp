// Maps written as points: which, how many, and how.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan_file.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;

using Cell = std::array<int, 3>;

/// The voxels at the points of a .ply of ours, relative to the lattice's middle.
std::multiset<Cell> cells_of(const std::string& ply, double resolution_m) {
  std::multiset<Cell> cells;
  const std::size_t begin = ply.find("end_header\n") + 11;
  for (std::size_t at = begin; at < ply.size(); at += 15) {
    std::array<float, 3> centre_m{};
    std::memcpy(centre_m.data(), &ply[at], 12);
    Cell cell{};
    for (std::size_t i = 0; i < 3; ++i) {
      cell[i] = static_cast<int>(std::floor(centre_m[i] / resolution_m));
    }
    cells.insert(cell);
  }
  return cells;
}

VoxelKey key_of(const Cell& cell) {
  return {static_cast<std::uint16_t>(32768 + cell[0]), static_cast<std::uint16_t>(32768 + cell[1]),
          static_cast<std::uint16_t>(32768 + cell[2])};
}

bool is_occupied(const UncertaintyMap& map, const Cell& cell) {
  return map.at(key_of(cell)).state == VoxelState::occupied;
}

/// Blocks of many sizes on a box of 32 voxels, free, occupied or unknown, so that leaves are
/// pruned and neighbours differ in size.
UncertaintyMap map_of_blocks(std::mt19937& random) {
  UncertaintyMap map(0.5);
  for (int i = 0; i < 60; ++i) {
    const int size = 1 << random() % 5;
    Cell least{};
    for (int& c : least) c = static_cast<int>(random() % (32 / size)) * size - 16;
    const bool is_free = random() % 3 == 0;
    for (int z = 0; z < size; ++z) {
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          map.set(key_of({least[0] + x, least[1] + y, least[2] + z}),
                  {.log_odds = is_free ? -1.0F : 1.0F});
        }
      }
    }
  }
  map.finish_writing();
  return map;
}

TEST(MapPoints, OfSurfacesAreThoseWithAFaceToWhatIsNotOccupied) {
  std::mt19937 random(7);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const UncertaintyMap map = map_of_blocks(random);
    std::multiset<Cell> all;
    std::multiset<Cell> surface;
    for (int x = -17; x <= 17; ++x) {
      for (int y = -17; y <= 17; ++y) {
        for (int z = -17; z <= 17; ++z) {
          if (!is_occupied(map, {x, y, z})) continue;
          all.insert({x, y, z});
          const bool is_inside =
              is_occupied(map, {x - 1, y, z}) && is_occupied(map, {x + 1, y, z}) &&
              is_occupied(map, {x, y - 1, z}) && is_occupied(map, {x, y + 1, z}) &&
              is_occupied(map, {x, y, z - 1}) && is_occupied(map, {x, y, z + 1});
          if (!is_inside) surface.insert({x, y, z});
        }
      }
    }
    EXPECT_LT(surface.size(), all.size());
    EXPECT_EQ(cells_of(map_file_bytes(map, MapFormat::colour_ply), 0.5), surface);
    EXPECT_EQ(cells_of(map_file_bytes(map, MapFormat::colour_ply, MapPoints::all), 0.5), all);
  }
}

/// A map of one leaf: a child of the root, or under first children down to that depth.
UncertaintyMap leaf_at(int depth) {
  std::string nodes;
  for (int i = 1; i < depth; ++i) nodes += std::string("\x03\x00", 2);
  nodes += std::string("\x02\x00", 2);
  std::istringstream in("# Octomap OcTree binary file\nid OcTree\nsize " +
                        std::to_string(depth + 1) + "\nres 0.05\ndata\n" + nodes);
  return read_map(in, "leaf.bt");
}

TEST(MapPoints, OfABigLeafAreItsSurface) {
  const UncertaintyMap map = leaf_at(8);  // 256 voxels an edge, at the lattice's corner
  const std::string ply = map_file_bytes(map, MapFormat::colour_ply);
  EXPECT_THAT(ply.substr(0, 100),
              HasSubstr("element vertex " + std::to_string(256 * 256 * 256 - 254 * 254 * 254)));
}

TEST(MapPoints, BeyondAllBoundsAreRefusedBeforeAnythingIsWritten) {
  const test::TemporaryFolder folder;
  const UncertaintyMap octant = leaf_at(1);  // 3.5e13 voxels
  for (const MapFormat format : {MapFormat::colour_ply, MapFormat::colour_pcd}) {
    for (const MapPoints points : {MapPoints::surface, MapPoints::all}) {
      EXPECT_THAT(test::message_of<InputError>(
                      [&] { write_map(octant, folder / "octant", format, points); }),
                  HasSubstr("more than 20000000"));
    }
  }
  // The surfaces of what is refused whole can still be written.
  EXPECT_THAT(test::message_of<InputError>([&] {
                write_map(leaf_at(7), folder / "leaf", MapFormat::colour_ply, MapPoints::all);
              }),
              HasSubstr("surfaces alone"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  write_map(leaf_at(7), folder / "leaf.ply", MapFormat::colour_ply);
}

TEST(MapPoints, AreTheSameInAPcd) {
  std::mt19937 random(8);
  const test::TemporaryFolder folder;
  const UncertaintyMap map = map_of_blocks(random);
  write_map(map, folder / "map.ply", MapFormat::colour_ply);
  write_map(map, folder / "map.pcd", MapFormat::colour_pcd);
  const auto ply = read_scan(folder / "map.ply").points_m;
  EXPECT_GT(ply.size(), 0U);
  EXPECT_EQ(read_scan(folder / "map.pcd").points_m, ply);
}

TEST(MapPoints, OfAPcdAreColouredAsPclDoes) {
  UncertaintyMap map(0.5);
  map.set(key_of({0, 1, -2}), {.log_odds = 1.0F, .uncertainty = 0.0F});
  const std::string pcd = map_file_bytes(map, MapFormat::colour_pcd);
  const std::string point = pcd.substr(pcd.find("DATA binary\n") + 12);
  ASSERT_EQ(point.size(), 16U);
  std::array<float, 3> centre_m{};
  std::memcpy(centre_m.data(), point.data(), 12);
  EXPECT_EQ(centre_m, (std::array<float, 3>{0.25F, 0.75F, -0.75F}));
  EXPECT_EQ(point.substr(12), std::string("\x00\xff\x00\x00", 4));  // blue, green, red
}

}  // namespace
}  // namespace nbvopt
