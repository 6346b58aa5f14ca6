#include "nbvopt/map/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <sstream>

#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/colour_ramp.hpp"
#include "support/error_message.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A small map with pruned leaves, colours and uncertainties.
UncertaintyMap small_map() {
  UncertaintyMap map(0.05);
  std::mt19937 random(3);
  for (std::uint16_t x = 0; x < 16; ++x) {
    for (std::uint16_t y = 0; y < 16; ++y) {
      for (std::uint16_t z = 0; z < 8; ++z) {
        VoxelRecord record{.state = VoxelState::free, .log_odds = -2.0F};
        if (x > 12) {
          record.log_odds = 0.5F + static_cast<float>(random() % 4);
          record.uncertainty = static_cast<float>(random() % 8) / 8.0F;
          record.colour = {static_cast<std::uint8_t>(random()), 7, 9};
        }
        map.set({static_cast<std::uint16_t>(32760 + x), static_cast<std::uint16_t>(32760 + y),
                 static_cast<std::uint16_t>(32760 + z)},
                record);
      }
    }
  }
  map.finish_writing();
  return map;
}

template <class Visit>
void for_each_voxel_around(const UncertaintyMap& map, const Visit& visit) {
  const KeyBox box = map.known_box().value();
  for (int x = box.min.x - 1; x <= box.max.x + 1; ++x) {
    for (int y = box.min.y - 1; y <= box.max.y + 1; ++y) {
      for (int z = box.min.z - 1; z <= box.max.z + 1; ++z) {
        visit(VoxelKey{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                       static_cast<std::uint16_t>(z)});
      }
    }
  }
}

TEST(MapFile, KeepsAllInAnUncertaintyOcTree) {
  const TemporaryFolder folder;
  const UncertaintyMap map = small_map();
  write_map(map, folder / "map.ot", MapFormat::uncertainty_ot);
  const UncertaintyMap read = read_map(folder / "map.ot");
  EXPECT_EQ(read.resolution_m(), map.resolution_m());
  EXPECT_EQ(read.counts().nodes, map.counts().nodes);
  for_each_voxel_around(map, [&](VoxelKey key) {
    const VoxelRecord a = map.at(key);
    const VoxelRecord b = read.at(key);
    EXPECT_EQ(a.state, b.state);
    EXPECT_EQ(a.log_odds, b.log_odds);
    EXPECT_EQ(a.uncertainty, b.uncertainty);
    EXPECT_EQ(a.colour, b.colour);
  });
}

TEST(MapFile, KeepsAResolutionToTheLastBit) {
  const TemporaryFolder folder;
  UncertaintyMap map(1.0 / 30.0);
  map.set({1, 2, 3}, {.log_odds = 1.0F});
  write_map(map, folder / "map.ot", MapFormat::uncertainty_ot);
  EXPECT_EQ(read_map(folder / "map.ot").resolution_m(), 1.0 / 30.0);
}

TEST(MapFile, KeepsAnEmptyMap) {
  const TemporaryFolder folder;
  for (const MapFormat format : {MapFormat::uncertainty_ot, MapFormat::bt, MapFormat::colour_ot}) {
    write_map(UncertaintyMap(0.1), folder / "map", format);
    EXPECT_EQ(read_map(folder / "map").counts().nodes, 0U);
  }
}

TEST(MapFile, WritesABtThatOctoMapOpens) {
  const TemporaryFolder folder;
  const UncertaintyMap map = small_map();
  write_map(map, folder / "map.bt", MapFormat::bt);
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(folder / "map.bt"));
  EXPECT_EQ(tree.getResolution(), map.resolution_m());
  for_each_voxel_around(map, [&](VoxelKey key) {
    const octomap::OcTreeNode* node = tree.search(octomap_key(key));
    const VoxelState state = map.at(key).state;
    ASSERT_EQ(node != nullptr, state != VoxelState::unknown);
    EXPECT_EQ(node != nullptr && tree.isNodeOccupied(node), state == VoxelState::occupied);
  });
  // What uncertainty kept apart is one state now, and pruned as OctoMap would.
  const std::size_t nodes = tree.size();
  tree.prune();
  EXPECT_EQ(tree.size(), nodes);
}

TEST(MapFile, ReadsABtAsOctoMapDoes) {
  const TemporaryFolder folder;
  write_map(small_map(), folder / "map.bt", MapFormat::bt);
  const UncertaintyMap map = read_map(folder / "map.bt");
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary(folder / "map.bt"));
  EXPECT_EQ(detail::MapAccess::tree(map).size(), tree.size());
  for_each_voxel_around(map, [&](VoxelKey key) {
    const octomap::OcTreeNode* node = tree.search(octomap_key(key));
    ASSERT_EQ(map.at(key).state == VoxelState::unknown, node == nullptr);
    EXPECT_EQ(map.at(key).log_odds, node != nullptr ? node->getLogOdds() : 0.0F);
  });
  EXPECT_FALSE(map.carries_uncertainty());
  EXPECT_EQ(detail::MapAccess::tree(map).getRoot()->getLogOdds(), tree.getRoot()->getLogOdds());
}

TEST(MapFile, ReadsABtOfAnotherTreeType) {
  std::stringstream file;
  octomap::ColorOcTree tree(0.1);
  tree.updateNode(octomap::point3d(0.55F, 0.35F, 0.25F), true);
  ASSERT_TRUE(tree.writeBinary(file));
  ASSERT_THAT(file.str(), HasSubstr("id ColorOcTree"));
  const UncertaintyMap map = read_map(file, "map.bt");
  EXPECT_EQ(map.at(map.lattice().key({0.55, 0.35, 0.25})).state, VoxelState::occupied);
}

TEST(MapFile, WritesAColorOcTreeThatOctoMapOpens) {
  const TemporaryFolder folder;
  const UncertaintyMap map = small_map();
  write_map(map, folder / "map.ot", MapFormat::colour_ot);
  const std::unique_ptr<octomap::AbstractOcTree> read(
      octomap::AbstractOcTree::read(folder / "map.ot"));
  const auto* tree = dynamic_cast<octomap::ColorOcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(tree->size(), map.counts().nodes);
  for_each_voxel_around(map, [&](VoxelKey key) {
    const octomap::ColorOcTreeNode* node = tree->search(octomap_key(key));
    const VoxelRecord record = map.at(key);
    ASSERT_EQ(node != nullptr, record.state != VoxelState::unknown);
    if (record.state != VoxelState::occupied) return;
    const auto [red, green, blue] = uncertainty_colour(record.uncertainty);
    EXPECT_EQ(node->getColor(), octomap::ColorOcTreeNode::Color(red, green, blue));
    EXPECT_EQ(node->getLogOdds(), record.log_odds);
  });
}

TEST(MapFile, ReadsOctoMapsFullFiles) {
  std::stringstream plain_file;
  octomap::OcTree plain(0.1);
  plain.updateNode(octomap::point3d(0.55F, 0.35F, 0.25F), 0.7F);
  plain.updateNode(octomap::point3d(0.65F, 0.35F, 0.25F), -0.3F);
  ASSERT_TRUE(plain.write(plain_file));
  const UncertaintyMap map = read_map(plain_file, "map.ot");
  EXPECT_EQ(map.at(map.lattice().key({0.55, 0.35, 0.25})).log_odds, 0.7F);
  EXPECT_EQ(map.at(map.lattice().key({0.65, 0.35, 0.25})).log_odds, -0.3F);

  std::stringstream colour_file;
  octomap::ColorOcTree colour(0.1);
  colour.updateNode(octomap::point3d(0.55F, 0.35F, 0.25F), 0.7F);
  colour.setNodeColor(0.55F, 0.35F, 0.25F, 10, 20, 30);
  ASSERT_TRUE(colour.write(colour_file));
  const UncertaintyMap coloured = read_map(colour_file, "map.ot");
  const VoxelRecord record = coloured.at(coloured.lattice().key({0.55, 0.35, 0.25}));
  EXPECT_EQ(record.log_odds, 0.7F);
  EXPECT_EQ(record.colour, (std::array<std::uint8_t, 3>{10, 20, 30}));
  EXPECT_EQ(record.uncertainty, 1.0F);
}

TEST(MapFile, RestoresTheOccupancyOfInnerNodes) {
  std::stringstream file;
  octomap::OcTree tree(0.1);
  tree.updateNode(octomap::point3d(0.55F, 0.35F, 0.25F), 0.7F);
  tree.updateNode(octomap::point3d(0.65F, 0.35F, 0.25F), -0.3F);
  tree.getRoot()->setLogOdds(-3.0F);
  ASSERT_TRUE(tree.write(file));
  EXPECT_TRUE(read_map(file, "map.ot").has_occupied());
}

TEST(MapFile, WritesOccupiedVoxelsAsColouredPoints) {
  const TemporaryFolder folder;
  UncertaintyMap map(0.5);
  map.set({32768, 32769, 32766}, {.log_odds = 1.0F, .uncertainty = 0.0F});
  map.set({32769, 32769, 32766}, {.log_odds = -1.0F});
  write_map(map, folder / "map.ply", MapFormat::colour_ply);
  const std::string ply = content(folder / "map.ply");
  EXPECT_THAT(ply, StartsWith("ply\nformat binary_little_endian 1.0\nelement vertex 1\n"));
  const std::string point = ply.substr(ply.find("end_header\n") + 11);
  ASSERT_EQ(point.size(), 15U);
  std::array<float, 3> centre_m{};
  std::memcpy(centre_m.data(), point.data(), 12);
  EXPECT_EQ(centre_m, (std::array<float, 3>{0.25F, 0.75F, -0.75F}));
  EXPECT_EQ(point.substr(12), std::string("\x00\xff\x00", 3));
}

TEST(MapFile, SaysWhyAFileCannotBeWritten) {
  const TemporaryFolder folder;
  const auto write = [](const std::string& path) {
    return test::message_of<InputError>(
        [&] { write_map(small_map(), path, MapFormat::uncertainty_ot); });
  };
  EXPECT_THAT(write(folder / "none/map.ot"), StartsWith(folder / "none/map.ot"));
  EXPECT_THAT(write(folder.path().string()), HasSubstr("folder"));
  EXPECT_THAT(write("/dev/full"), HasSubstr("No space left"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// Everything that may stand where a map was expected is refused in one line that names it.
class DamagedMap : public ::testing::Test {
 protected:
  static std::string message(const std::string& bytes) {
    std::istringstream in(bytes);
    const std::string message = test::message_of<InputError>([&] { read_map(in, "some.ot"); });
    EXPECT_THAT(message, StartsWith("some.ot: ")) << "no refusal";
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }

  static std::string header(const std::string& id, const std::string& size,
                            const std::string& resolution = "0.1") {
    return "# Octomap OcTree file\n# comment\nid " + id + "\nsize " + size + "\nres " + resolution +
           "\ndata\n";
  }

  static std::string node(float log_odds, std::uint8_t mask) {
    const auto bytes = std::bit_cast<std::array<char, 4>>(log_odds);
    return std::string(bytes.data(), 4) + static_cast<char>(mask);
  }
};

TEST_F(DamagedMap, IsMissingOrAFolder) {
  const TemporaryFolder folder;
  for (const std::string& path : {folder / "none.ot", folder.path().string()}) {
    EXPECT_THAT(test::message_of<InputError>([&] { read_map(path); }), StartsWith(path + ": "));
  }
  const std::string empty = folder.write("empty.ot", "");
  EXPECT_THAT(test::message_of<InputError>([&] { read_map(empty); }), HasSubstr("empty"));
}

TEST_F(DamagedMap, IsNoMap) {
  message("");
  message("\n");
  message("some text\nand more\n");
  message(std::string(100000, '\xff'));
  std::mt19937 random(5);
  std::string bytes(5000, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  message(bytes);
}

TEST_F(DamagedMap, HasABadHeader) {
  EXPECT_THAT(message("# Octomap OcTree file\n"), HasSubstr("data"));
  EXPECT_THAT(message("# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\n"), HasSubstr("data"));
  EXPECT_THAT(message("# Octomap OcTree file\nsize 1\nres 0.1\ndata\n"), HasSubstr("id"));
  EXPECT_THAT(message("# Octomap OcTree file\nid OcTree\nsize 1\ndata\n"), HasSubstr("res"));
  for (const char* resolution : {"0", "-0.1", "nan", "inf", "0.1m", ""}) {
    EXPECT_THAT(message(header("OcTree", "1", resolution) + node(1, 0)), HasSubstr("res"));
  }
}

TEST_F(DamagedMap, IsTruncatedAnywhere) {
  const TemporaryFolder folder;
  for (const MapFormat format : {MapFormat::uncertainty_ot, MapFormat::bt, MapFormat::colour_ot}) {
    write_map(small_map(), folder / "map", format);
    const std::string bytes = content(folder / "map");
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
      message(bytes.substr(0, size));
    }
    message(bytes.substr(0, bytes.size() - 1));
  }
}

TEST_F(DamagedMap, HasAnotherNumberOfNodesThanItSays) {
  EXPECT_THAT(message(header("OcTree", "1") + node(1, 1) + node(1, 0)), HasSubstr("more than"));
  EXPECT_THAT(message(header("OcTree", "3") + node(1, 1) + node(1, 0)), HasSubstr("2 nodes"));
  // A huge number must not be believed.
  EXPECT_THAT(message(header("OcTree", "18446744073709551615") + node(1, 0)), HasSubstr("1 nodes"));
}

TEST_F(DamagedMap, IsTooDeep) {
  std::string chain;
  for (int depth = 0; depth < 17; ++depth) chain += node(1, 1);
  EXPECT_THAT(message(header("OcTree", "18") + chain + node(1, 0)), HasSubstr("deeper"));
  const std::string binary_header =
      "# Octomap OcTree binary file\nid OcTree\nsize 99999999\nres 0.1\ndata\n";
  EXPECT_THAT(message(binary_header + std::string(100, '\xff')), HasSubstr("deeper"));
  EXPECT_THAT(message(binary_header + std::string(100, '\0')), HasSubstr("no children"));
}

TEST_F(DamagedMap, HasBadValues) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(message(header("OcTree", "1") + node(nan, 0)), HasSubstr("log-odds"));
  for (const float uncertainty : {nan, infinity, -0.1F, 1.1F}) {
    const std::string bytes = node(1.0F, 'r').substr(0, 4) + "rgb" + node(uncertainty, 0);
    EXPECT_THAT(message(header("UncertaintyOcTree", "1") + bytes), HasSubstr("uncertainty"));
  }
}

class SharedMaps : public ::testing::Test {
 protected:
  static std::filesystem::path map(const std::string& name) {
    return test::shared_dir() / "maps" / name;
  }
};

/// The table of the known answers' README.
TEST_F(SharedMaps, HaveTheCountsThatAreKnown) {
  NBVOPT_REQUIRE_SHARED();
  struct Row {
    const char* name;
    std::uint64_t occupied, free, certain;
    double information;
  };
  for (const Row& row : {Row{"ASLAM_lab.bt", 178658, 2767691, 0, 0.0},
                         Row{"apartment_partial.ot", 15128, 154312, 10631, 5017.4},
                         Row{"warehouse_partial.ot", 10748, 134976, 6816, 3210.9}}) {
    const MapCounts counts = read_map(map(row.name)).counts();
    EXPECT_EQ(counts.occupied_voxels, row.occupied) << row.name;
    EXPECT_EQ(counts.free_voxels, row.free) << row.name;
    EXPECT_EQ(counts.certain_voxels, row.certain) << row.name;
    EXPECT_NEAR(counts.information, row.information, 0.05) << row.name;
  }
}

TEST_F(SharedMaps, AreTheSameBytesAfterReadingAndWriting) {
  NBVOPT_REQUIRE_SHARED();
  const TemporaryFolder folder;
  for (const char* name : {"apartment_partial.ot", "warehouse_partial.ot"}) {
    write_map(read_map(map(name)), folder / "map.ot", MapFormat::uncertainty_ot);
    EXPECT_TRUE(content(folder / "map.ot") == content(map(name))) << name;
  }
  for (const char* name : {"ASLAM_lab.bt", "geb079.bt", "catec.bt"}) {
    write_map(read_map(map(name)), folder / "map.bt", MapFormat::bt);
    EXPECT_TRUE(content(folder / "map.bt") == content(map(name))) << name;
  }
}

TEST(MapFormats, GoByNameOrElseByExtension) {
  EXPECT_EQ(map_format("", "a.ot"), MapFormat::uncertainty_ot);
  EXPECT_EQ(map_format("", "a"), MapFormat::uncertainty_ot);
  EXPECT_EQ(map_format("", "a.b/c.bt"), MapFormat::bt);
  EXPECT_EQ(map_format("", "a.ply"), MapFormat::colour_ply);
  EXPECT_EQ(map_format("colour-ot", "a.ply"), MapFormat::colour_ot);
  EXPECT_THAT(test::message_of<UsageError>([] { map_format("", "a.txt"); }),
              HasSubstr("a.txt: the extension tells no format"));
  EXPECT_THAT(test::message_of<UsageError>([] { map_format("octo", "a.ot"); }),
              HasSubstr("map format 'octo' is not known"));
}

}  // namespace
}  // namespace nbvopt
