// Maps as other programs write them: tree types, values, headers, packing, messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <octomap/OcTreeStamped.h>
#include <zlib.h>

#include <bit>
#include <limits>
#include <map>
#include <sstream>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class Number>
std::string bytes_of(Number number) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  return {bytes.data(), bytes.size()};
}

std::string full_header(const std::string& id, const std::string& size_line) {
  return "# Octomap OcTree file\nid " + id + "\n" + size_line + "res 0.1\ndata\n";
}

/// A node of an .ot: log-odds, whatever else its type stores, which children follow.
std::string node(float log_odds, std::uint8_t children, const std::string& others = "") {
  return bytes_of(log_odds) + others + static_cast<char>(children);
}

/// A root with a free and an occupied child, each of an eighth of the lattice.
std::string three_nodes(const std::string& others = "", float root = 1.5F) {
  return node(root, 0b11, others) + node(-0.4F, 0, others) + node(1.5F, 0, others);
}

struct Reading {
  UncertaintyMap map;
  std::vector<std::string> warnings;
};

Reading reading(const std::string& bytes) {
  std::istringstream in(bytes);
  std::vector<std::string> warnings;
  UncertaintyMap map = read_map(in, "some.ot", warnings);
  return {std::move(map), std::move(warnings)};
}

std::string refusal(const std::string& bytes) {
  std::istringstream in(bytes);
  std::string message = test::message_of<InputError>([&] { read_map(in, "some.ot"); });
  EXPECT_THAT(message, StartsWith("some.ot: ")) << "no refusal";
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

void expect_three_nodes(const UncertaintyMap& map) {
  EXPECT_EQ(map.counts().nodes, 3U);
  EXPECT_EQ(map.at({0, 0, 0}).log_odds, -0.4F);
  EXPECT_EQ(map.at({40000, 0, 0}).log_odds, 1.5F);
  EXPECT_EQ(map.at({0, 40000, 0}).state, VoxelState::unknown);
}

template <class Tree>
std::string octomap_file(bool is_binary = false) {
  Tree tree(0.1);
  tree.updateNode(octomap::point3d(0.55F, 0.35F, 0.25F), 0.7F);
  tree.updateNode(octomap::point3d(0.65F, 0.35F, 0.25F), -0.3F);
  std::ostringstream file;
  EXPECT_TRUE(is_binary ? tree.writeBinary(file) : tree.write(file));
  return file.str();
}

/// What follows the header: a message's `data`.
std::string nodes_of(const std::string& file) { return file.substr(file.find("\ndata\n") + 6); }

TEST(ForeignMap, OfStampedNodesIsRead) {
  const auto [map, warnings] = reading(octomap_file<octomap::OcTreeStamped>());
  EXPECT_EQ(map.at(map.lattice().key({0.55, 0.35, 0.25})).log_odds, 0.7F);
  EXPECT_EQ(map.at(map.lattice().key({0.65, 0.35, 0.25})).log_odds, -0.3F);
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(ForeignMap, OfATypeThatDerivesFromOctoMapsKeepsItsOccupancy) {
  for (const std::string others : {"", "s", "time", "three floats"}) {
    const auto [map, warnings] = reading(full_header("MyTree", "size 3\n") + three_nodes(others));
    expect_three_nodes(map);
    EXPECT_THAT(warnings,
                ElementsAre(AllOf(HasSubstr("'MyTree' is not known"),
                                  HasSubstr("other " + std::to_string(others.size()) + " bytes"))));
  }
}

TEST(ForeignMap, OfATypeWithoutOccupancyIsRefusedWithAWayOut) {
  const auto refused = AllOf(HasSubstr("'MyTree' is not known"), HasSubstr("writeBinary()"));
  // Inner nodes that are no maximum, nodes of several sizes, no count of nodes.
  EXPECT_THAT(refusal(full_header("MyTree", "size 3\n") + three_nodes("", 9.0F)), refused);
  EXPECT_THAT(refusal(full_header("MyTree", "size 3\n") + three_nodes() + "x"), refused);
  EXPECT_THAT(refusal(full_header("MyTree", "") + three_nodes()), refused);
  EXPECT_THAT(refusal(full_header("CountingOcTree", "size 3\n") + three_nodes()),
              HasSubstr("writeBinary()"));
}

TEST(ForeignMap, OfInfiniteLogOddsIsCertainAsFarAsOctoMapGoes) {
  const auto [map, warnings] = reading(full_header("OcTree", "size 3\n") + node(kInfinity, 0b11) +
                                       node(-kInfinity, 0) + node(kInfinity, 0));
  const octomap::OcTree limits(0.1);
  EXPECT_EQ(map.at({0, 0, 0}).log_odds, limits.getClampingThresMinLog());
  EXPECT_EQ(map.at({40000, 0, 0}).log_odds, limits.getClampingThresMaxLog());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("3 nodes have an infinite log-odds")));
  // So it is in every tree type.
  const std::string rgb = "rgb";
  EXPECT_EQ(reading(full_header("ColorOcTree", "size 1\n") + node(-kInfinity, 0, rgb))
                .map.at({0, 0, 0})
                .log_odds,
            limits.getClampingThresMinLog());
}

TEST(ForeignMap, WithoutANumberOfNodesIsReadToItsLast) {
  for (const std::string size : {"", "size 0\n", "size SIZE\n", "size -1\n", "size\n"}) {
    const auto [map, warnings] = reading(full_header("OcTree", size) + three_nodes());
    expect_three_nodes(map);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("all that follow were read"))) << size;
    EXPECT_THAT(refusal(full_header("OcTree", size) + node(1.5F, 0b11) + node(-0.4F, 0)),
                HasSubstr("truncated"));
  }
  EXPECT_EQ(reading(full_header("OcTree", "size 0\n")).map.counts().nodes, 0U);
}

TEST(ForeignMap, OfAnotherKindIsToldApartAndRefusedWithARemedy) {
  const std::map<std::string, std::string> files{
      {"PK\x03\x04 map.bt", "unpack it first"},
      {"BZh91AY&SY", "unpack it first"},
      {"# .PCD v0.7 - Point Cloud Data file format\n", "insert it into a map"},
      {"ply\nformat ascii 1.0\n", "insert it into a map"},
      {"P5\n2 2\n255\n1234", "no heights"},
      {"image: a.pgm\nresolution: 0.05\n", "no heights"},
      {"# UFOMap octree file\nversion 1.0.0\n", "write its map as a .bt"},
      {"Bonxai::VoxelGrid<float,2,3>(0.05)\n", "write its map as a .bt"},
      {"#ROSBAG V2.0\n", "bytes of `data`"},
      {"header:\n  frame_id: map\nbinary: true\n", "bytes of its `data`"},
      {"{\"id\": \"OcTree\", \"data\": [0, 3]}", "bytes of its `data`"},
      {"anything", "with that program"},
      {"#", "with that program"},
  };
  for (const auto& [bytes, remedy] : files) {
    EXPECT_THAT(refusal(bytes), AllOf(HasSubstr("not an OctoMap file"), HasSubstr(remedy)));
  }
}

TEST(ForeignMap, OfOctoMapsFirstBinaryFormatIsRead) {
  const std::string file = octomap_file<octomap::OcTree>(true);
  const auto count = bytes_of(static_cast<std::uint32_t>(reading(file).map.counts().nodes));
  const std::string header = bytes_of(std::int32_t{3}) + bytes_of(0.1);
  const auto [map, warnings] = reading(header + count + nodes_of(file));
  EXPECT_EQ(map.at(map.lattice().key({0.55, 0.35, 0.25})).state, VoxelState::occupied);
  EXPECT_EQ(map.at(map.lattice().key({0.65, 0.35, 0.25})).state, VoxelState::free);
  EXPECT_THAT(warnings, IsEmpty());
  refusal(header);
  refusal(bytes_of(std::int32_t{3}) + bytes_of(-0.1) + count + nodes_of(file));
}

/// As `gzip` packs it.
std::string packed(const std::string& bytes) {
  z_stream zlib{};
  constexpr int kGzip = 16;
  EXPECT_EQ(deflateInit2(&zlib, 9, Z_DEFLATED, MAX_WBITS + kGzip, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&zlib, bytes.size()), '\0');
  zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  zlib.avail_in = static_cast<uInt>(bytes.size());
  zlib.next_out = reinterpret_cast<Bytef*>(out.data());
  zlib.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&zlib, Z_FINISH), Z_STREAM_END);
  const std::size_t size = zlib.total_out;
  deflateEnd(&zlib);
  return out.substr(0, size);
}

TEST(PackedMap, IsReadWhateverItsName) {
  const std::string file = full_header("OcTree", "size 3\n") + three_nodes();
  expect_three_nodes(reading(packed(file)).map);
  // Members that were joined, and a tape's padding.
  expect_three_nodes(reading(packed(file.substr(0, 20)) + packed(file.substr(20))).map);
  expect_three_nodes(reading(packed(file) + std::string(512, '\0')).map);
  const test::TemporaryFolder folder;
  expect_three_nodes(read_map(folder.write("map.ot.gz", packed(file))));
}

TEST(PackedMap, ThatIsDamagedIsRefused) {
  const std::string good = packed(octomap_file<octomap::OcTree>());
  for (std::size_t size = 1; size < good.size(); ++size) refusal(good.substr(0, size));
  std::string bytes = good;
  bytes[bytes.size() - 8] ^= 1;  // of the checksum
  EXPECT_THAT(refusal(bytes), HasSubstr("damaged"));
  EXPECT_THAT(refusal(packed("no map")), HasSubstr("not an OctoMap file"));
}

/// Inner nodes of a .bt that are all full, that many levels and one of leaves below: four nodes a
/// byte, which gzip packs to a thousandth.
std::string full_binary_nodes(int depth) {
  if (depth == 0) return "\x99\x99";
  const std::string below = full_binary_nodes(depth - 1);
  std::string bytes = "\xff\xff";
  for (int i = 0; i < 8; ++i) bytes += below;
  return bytes;
}

TEST(PackedMap, ThatGrowsAsNoRecordedMapDoesIsRefused) {
  const std::string nodes = full_binary_nodes(6);
  const std::string file =
      "# Octomap OcTree binary file\nid OcTree\nsize 0\nres 0.1\ndata\n" + nodes;
  EXPECT_THAT(refusal(packed(file)),
              AllOf(HasSubstr("more than 10 times its size"), HasSubstr("gunzip")));
  // The remedy that the message names.
  EXPECT_GT(reading(file).map.counts().nodes, 2'000'000U);
  // An .ot has fewer nodes a byte.
  EXPECT_THAT(refusal(packed(full_header("OcTree", "") + std::string(20 << 20, '\0'))),
              AnyOf(HasSubstr("more than 50 times"), HasSubstr("deeper")));
}

class MapMessageData : public ::testing::Test {
 protected:
  static UncertaintyMap read(const std::string& data, const MapMessage& message) {
    std::istringstream in(data);
    std::vector<std::string> warnings;
    return read_map_message(in, "data.bin", message, warnings);
  }
  static std::string refusal_of(const std::string& data, const MapMessage& message) {
    return test::message_of<InputError>([&] { read(data, message); });
  }
};

TEST_F(MapMessageData, IsAFileWithoutItsHeader) {
  for (const bool is_binary : {true, false}) {
    const std::map<std::string, std::string> files{
        {"OcTree", octomap_file<octomap::OcTree>(is_binary)},
        {"ColorOcTree", octomap_file<octomap::ColorOcTree>(is_binary)},
        {"OcTreeStamped", octomap_file<octomap::OcTreeStamped>(is_binary)}};
    for (const auto& [type, file] : files) {
      const MapMessage message{.tree_type = type, .resolution_m = 0.1, .is_binary = is_binary};
      const UncertaintyMap from_message = read(nodes_of(file), message);
      const UncertaintyMap from_file = reading(file).map;
      EXPECT_EQ(map_file_bytes(from_message, MapFormat::uncertainty_ot),
                map_file_bytes(from_file, MapFormat::uncertainty_ot))
          << type << is_binary;
    }
  }
  EXPECT_EQ(read("", {.tree_type = "OcTree", .resolution_m = 0.1}).counts().nodes, 0U);
}

TEST_F(MapMessageData, IsRefusedWhereItsFieldsDoNotFit) {
  const std::string data = nodes_of(octomap_file<octomap::OcTree>());
  EXPECT_THAT(refusal_of(data, {.tree_type = "OcTree", .resolution_m = 0.0}),
              HasSubstr("resolution is 0 m"));
  EXPECT_NE(refusal_of(data, {.tree_type = "ColorOcTree", .resolution_m = 0.1}), "");
  EXPECT_NE(refusal_of(data, {.tree_type = "OcTree", .resolution_m = 0.1, .is_binary = true}), "");
  EXPECT_THAT(refusal_of(data + "x", {.tree_type = "OcTree", .resolution_m = 0.1}),
              HasSubstr("bytes are left"));
  EXPECT_THAT(refusal_of(data, {.tree_type = "MyTree", .resolution_m = 0.1}),
              HasSubstr("writeBinary()"));
}

}  // namespace
}  // namespace nbvopt
