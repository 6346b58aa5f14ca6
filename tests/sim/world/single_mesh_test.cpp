// Meshes that are worlds by themselves: formats, units, which way is up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::has_vertex;
using test::message_of;
using test::WorldFolder;
using testing::HasSubstr;

template <class Number>
std::string bytes_of(Number number) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  return {bytes.data(), bytes.size()};
}

/// A triangle that goes 2 along the file's y and 3 along its z, at x = 1.
std::string corner_bytes() {
  std::string bytes;
  for (const float number : {1.F, 0.F, 0.F, 1.F, 2.F, 0.F, 1.F, 2.F, 3.F}) {
    bytes += bytes_of(number);
  }
  return bytes;
}

/// glTF 2.0 with the triangle in a buffer that is there in this way.
std::string gltf(const std::string& buffer) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [1, 0, 0], "max": [1, 2, 3]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{)" +
         buffer + R"("byteLength": 36}]})";
}

/// The same in one binary file: a header, then a chunk of JSON and one of numbers.
std::string glb() {
  std::string json = gltf("");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto chunk = [](const std::string& type, const std::string& bytes) {
    return bytes_of(static_cast<std::uint32_t>(bytes.size())) + type + bytes;
  };
  const std::string chunks = chunk("JSON", json) + chunk(std::string("BIN\0", 4), corner_bytes());
  return "glTF" + bytes_of(std::uint32_t{2}) +
         bytes_of(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

void expect_triangle(const World& world, const Eigen::Vector3d& second_m,
                     const Eigen::Vector3d& third_m, double unit_m = 1.0) {
  ASSERT_EQ(world.mesh.triangles.size(), 1U);
  EXPECT_TRUE(has_vertex(world.mesh, unit_m * Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE(has_vertex(world.mesh, unit_m * second_m));
  EXPECT_TRUE(has_vertex(world.mesh, unit_m * third_m));
  EXPECT_EQ(world.models, 0U);
}

TEST(SingleMesh, OfGltfHasItsYAxisUp) {
  const WorldFolder folder;
  folder.add_file("corners.bin", corner_bytes());
  const std::string embedded =
      R"("uri": "data:application/octet-stream;base64,AACAPwAAAAAAAAAAAACAPwAAAEAAAAAAAACAPwAAAEAAAEBA", )";
  const auto files = {
      folder.add_file("beside.gltf", gltf(R"("uri": "corners.bin", )")),
      folder.add_file("embedded.gltf", gltf(embedded)),
      folder.add_file("Binary.GLB", glb()),
  };
  for (const auto& file : files) {
    SCOPED_TRACE(file);
    expect_triangle(read_world(file, {}), {1, 0, 2}, {1, -3, 2});
  }
}

/// As in Gazebo: a model's pose was made for what Gazebo shows.
TEST(SingleMesh, OfGltfKeepsItsAxesAsAModelInAWorld) {
  const WorldFolder folder;
  folder.add_file("worlds/a.glb", glb());
  const World world = read_world(
      folder.add_world("<model name='m'><link name='l'><visual name='v'><geometry><mesh><uri>a.glb"
                       "</uri></mesh></geometry></visual></link></model>"),
      {});
  EXPECT_TRUE(has_vertex(world.mesh, {1, 2, 0}));
  EXPECT_TRUE(has_vertex(world.mesh, {1, 2, 3}));
}

TEST(SingleMesh, OfOffIsRead) {
  const WorldFolder folder;
  const auto file = folder.add_file("a.off", "OFF\n3 1 0\n1 0 0\n1 2 0\n1 2 3\n3 0 1 2\n");
  expect_triangle(read_world(file, {}), {1, 2, 0}, {1, 2, 3});
}

TEST(SingleMesh, IsInTheUnitThatIsGiven) {
  const WorldFolder folder;
  const auto stl =
      folder.add_file("a.stl",
                      "solid a\nfacet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 1 2 0\n"
                      "vertex 1 2 3\nendloop\nendfacet\nendsolid a\n");
  for (const double unit_m : {1.0, 0.001, 0.0254}) {
    const World world = read_world(stl, {.mesh_unit_m = unit_m});
    expect_triangle(world, {1, 2, 0}, {1, 2, 3}, unit_m);
    EXPECT_NEAR(world.bounds_m.max().z(), 3 * unit_m, 1e-6);
  }
  expect_triangle(read_world(folder.add_file("a.glb", glb()), {.mesh_unit_m = 0.001}), {1, 0, 2},
                  {1, -3, 2}, 0.001);
}

TEST(SingleMesh, ThatIsFarTooLongIsToldToHaveAnotherUnit) {
  const WorldFolder folder;
  const auto file = folder.add_file("a.off", "OFF\n3 1 0\n0 0 0\n0 9000 0\n5000 0 0\n3 0 1 2\n");
  EXPECT_THAT(read_world(file, {}).warnings,
              testing::ElementsAre(HasSubstr("the mesh is 9000 m long")));
  EXPECT_THAT(read_world(file, {.mesh_unit_m = 0.001}).warnings, testing::IsEmpty());
}

TEST(SingleMesh, IsKeptForEachUnitAndUntilAFileThatItNamesChanges) {
  const WorldFolder folder;
  folder.add_file("corners.bin", corner_bytes());
  const auto file = folder.add_file("a.gltf", gltf(R"("uri": "corners.bin", )"));
  const auto read = [&](double unit_m) {
    return read_world(file, {.mesh_unit_m = unit_m, .cache_folder = folder.path() / "cache"});
  };
  expect_triangle(read(1.0), {1, 0, 2}, {1, -3, 2});
  expect_triangle(read(0.5), {1, 0, 2}, {1, -3, 2}, 0.5);
  expect_triangle(read(1.0), {1, 0, 2}, {1, -3, 2});
  std::string moved = corner_bytes();
  moved.replace(4, 4, bytes_of(7.0F));
  std::filesystem::last_write_time(
      folder.add_file("corners.bin", moved),
      std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_TRUE(has_vertex(read(1.0).mesh, {1, 0, 7}));
}

TEST(SingleMesh, IsRefusedInAUnitThatCannotBe) {
  const WorldFolder folder;
  const auto mesh = folder.add_file("a.glb", glb());
  const auto refusal_of = [](const std::filesystem::path& file, double unit_m) {
    return message_of<InputError>([&] { read_world(file, {.mesh_unit_m = unit_m}); });
  };
  for (const double unit_m : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(refusal_of(mesh, unit_m), HasSubstr("must be positive and finite"));
  }
  EXPECT_THAT(refusal_of(folder.add_world("<model name='m'/>"), 0.001), HasSubstr("<scale>"));
  EXPECT_THAT(refusal_of(folder.add_file("a.gltf", gltf(R"("uri": "none.bin", )")), 1.0),
              HasSubstr("a.gltf: cannot be read as a mesh"));
}

}  // namespace
}  // namespace nbvopt
