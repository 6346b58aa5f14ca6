// Meshes of every kind that worlds name, written by hand.
#include "sim/world/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using test::has_vertex;
using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

/// A COLLADA file with geometries and a scene.
std::string collada(const std::string& asset, const std::string& geometries,
                    const std::string& nodes) {
  return "<?xml version='1.0' encoding='utf-8'?>\n"
         "<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>" +
         asset + "</asset><library_geometries>" + geometries +
         "</library_geometries><library_visual_scenes><visual_scene id='s'>" + nodes +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
         "</COLLADA>\n";
}

/// A geometry with the corners (0 0 3), (1 0 3), (0 2 3), (1 2 3) and these primitives.
std::string geometry(const std::string& name, const std::string& primitives) {
  return "<geometry id='" + name + "' name='" + name + "'><mesh><source id='" + name +
         "-p'><float_array id='" + name +
         "-a' count='12'>0 0 3 1 0 3 0 2 3 1 2 3</float_array><technique_common><accessor "
         "source='#" +
         name +
         "-a' count='4' stride='3'><param name='X' type='float'/><param name='Y' "
         "type='float'/><param name='Z' type='float'/></accessor></technique_common></source>"
         "<vertices id='" +
         name + "-v'><input semantic='POSITION' source='#" + name + "-p'/></vertices>" +
         primitives + "</mesh></geometry>";
}

std::string primitive(const std::string& kind, const std::string& owner, int count,
                      const std::string& indices) {
  return "<" + kind + " count='" + std::to_string(count) + "'><input semantic='VERTEX' source='#" +
         owner + "-v' offset='0'/>" + indices + "</" + kind + ">";
}

const std::string one_triangle = geometry("g", primitive("triangles", "g", 1, "<p>0 1 2</p>"));

std::string node(const std::string& transform, const std::string& url, const std::string& more = "",
                 const std::string& name = "node") {
  return "<node name='" + name + "'>" + transform + "<instance_geometry url='#" + url + "'/>" +
         more + "</node>";
}

TriangleMesh read_text_as(const std::string& name, const std::string& content,
                          const Submesh& submesh = {}) {
  const TemporaryFolder folder;
  WorldLog log;
  return read_mesh_file(folder.write(name, content), submesh, log);
}

TEST(MeshFile, TakesColladaUnitsFromTheirNumberWhateverTheirName) {
  const struct {
    std::string unit;
    double scale;
  } cases[] = {{"", 1.0},
               {"<unit name='meter' meter='1'/>", 1.0},
               {"<unit meter='0.010000' name='centimeter'/>", 0.01},
               {"<unit name='inch' meter='0.0254'/>", 0.0254},
               {"<unit name='centimeter' meter='1.000000'/>", 1.0}};
  for (const auto& [unit, scale] : cases) {
    const TriangleMesh mesh = read_text_as("a.dae", collada(unit, one_triangle, node("", "g")));
    ASSERT_EQ(mesh.triangles.size(), 1U) << unit;
    EXPECT_TRUE(has_vertex(mesh, scale * Eigen::Vector3d(1, 0, 3))) << unit;
    EXPECT_TRUE(has_vertex(mesh, scale * Eigen::Vector3d(0, 2, 3))) << unit;
  }
}

TEST(MeshFile, LeavesTheUpAxisOfColladaAlone) {
  for (const std::string axis : {"X_UP", "Y_UP", "Z_UP"}) {
    const TriangleMesh mesh = read_text_as(
        "a.dae", collada("<up_axis>" + axis + "</up_axis>", one_triangle, node("", "g")));
    EXPECT_TRUE(has_vertex(mesh, {0, 2, 3})) << axis;
  }
}

TEST(MeshFile, PlacesEveryInstanceByAllNodesAboveIt) {
  const std::string child = node("<rotate>0 0 1 90</rotate>", "g", "", "child");
  const TriangleMesh mesh = read_text_as(
      "a.dae", collada("<unit meter='0.01'/>", one_triangle,
                       node("<translate>100 0 0</translate><scale>2 1 1</scale>", "g", child)));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  // Parent: (2 x + 100, y, z) cm.
  EXPECT_TRUE(has_vertex(mesh, {1.02, 0.0, 0.03}));
  EXPECT_TRUE(has_vertex(mesh, {1.0, 0.02, 0.03}));
  // Child: turned to (-y, x, z) first.
  EXPECT_TRUE(has_vertex(mesh, {1.0, 0.01, 0.03}));
  EXPECT_TRUE(has_vertex(mesh, {0.96, 0.0, 0.03}));
}

TEST(MeshFile, KeepsOutsidesOutsideWhenANodeMirrors) {
  const auto normal_z = [](const TriangleMesh& mesh) {
    const auto& [a, b, c] = mesh.triangles.at(0);
    const Eigen::Vector3f& corner = mesh.vertices_m[a];
    return (mesh.vertices_m[b] - corner).cross(mesh.vertices_m[c] - corner).z();
  };
  EXPECT_GT(normal_z(read_text_as("a.dae", collada("", one_triangle, node("", "g")))), 0.0F);
  const TriangleMesh mirrored =
      read_text_as("a.dae", collada("", one_triangle, node("<scale>-1 1 1</scale>", "g")));
  EXPECT_TRUE(has_vertex(mirrored, {-1, 0, 3}));
  EXPECT_GT(normal_z(mirrored), 0.0F);
}

TEST(MeshFile, LeavesLinesAndTrianglesWithoutAreaBehind) {
  const std::string mixed =
      geometry("g", primitive("lines", "g", 1, "<p>0 3</p>") +
                        primitive("triangles", "g", 3, "<p>0 1 2 0 1 1 3 3 3</p>"));
  const TriangleMesh mesh = read_text_as("a.dae", collada("", mixed, node("", "g")));
  EXPECT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.vertices_m.size(), 3U);
  EXPECT_FALSE(has_vertex(mesh, {1, 2, 3}));
}

TEST(MeshFile, CutsPolygonsIntoTriangles) {
  const std::string square =
      geometry("g", primitive("polylist", "g", 1, "<vcount>4</vcount><p>0 1 3 2</p>"));
  const TriangleMesh mesh = read_text_as("a.dae", collada("", square, node("", "g")));
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_TRUE(has_vertex(mesh, {1, 2, 3}));
}

TEST(MeshFile, TakesASubmeshByItsNameAndCentresIt) {
  const std::string file = collada(
      "", one_triangle + geometry("h", primitive("triangles", "h", 1, "<p>1 2 3</p>")),
      node("", "g", "", "first") + node("<translate>10 0 0</translate>", "h", "", "second"));
  EXPECT_EQ(read_text_as("a.dae", file).triangles.size(), 2U);
  for (const std::string name : {"second", "h"}) {
    const TriangleMesh mesh = read_text_as("a.dae", file, {.name = name});
    EXPECT_EQ(mesh.triangles.size(), 1U) << name;
    EXPECT_TRUE(has_vertex(mesh, {11, 2, 3})) << name;
  }
  // The box of the submesh is (10..11, 0..2, 3).
  const TriangleMesh centred = read_text_as("a.dae", file, {.name = "h", .is_centred = true});
  EXPECT_TRUE(has_vertex(centred, {0.5, 1, 0}));
  EXPECT_THAT(message_of<InputError>([&] { read_text_as("a.dae", file, {.name = "third"}); }),
              HasSubstr("holds no triangle of a submesh 'third'"));
}

TEST(MeshFile, ReadsTheOtherFormats) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 3\n1 0 3\n0 2 3\n3 0 1 2\n";
  std::string binary_stl(80, ' ');
  const auto append = [&](auto value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(value)>>(value);
    binary_stl.append(bytes.begin(), bytes.end());
  };
  append(std::uint32_t{1});
  for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, 3.F, 1.F, 0.F, 3.F, 0.F, 2.F, 3.F}) {
    append(number);
  }
  append(std::uint16_t{0});
  const std::pair<std::string, std::string> files[] = {
      {"a.stl", test::triangle_stl()},
      {"b.stl", binary_stl},
      {"a.ply", ply},
      {"a.obj", "mtllib absent.mtl\nv 0 0 3\nv 1 0 3\nv 0 2 3\nf 1 2 3\n"}};
  for (const auto& [name, content] : files) {
    const TemporaryFolder folder;
    const World world = read_world(folder.write(name, content), {});
    ASSERT_EQ(world.mesh.triangles.size(), 1U) << name;
    EXPECT_TRUE(has_vertex(world.mesh, {1, 0, 3})) << name;
    EXPECT_TRUE(has_vertex(world.mesh, {0, 2, 3})) << name;
    EXPECT_EQ(world.models, 0U);
    EXPECT_TRUE(world.bounds_m.isApprox(
        Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(1, 2, 3))))
        << name;
  }
}

TEST(MeshFile, RefusesWhatIsNoMeshAndNamesTheFile) {
  const std::string whole = collada("", one_triangle, node("", "g"));
  const std::string no_triangle = geometry("g", primitive("triangles", "g", 0, "<p></p>"));
  const std::tuple<std::string, std::string, std::string> files[] = {
      {"truncated.dae", whole.substr(0, whole.size() / 2), "cannot be read as a mesh"},
      {"nothing.dae", collada("", no_triangle, node("", "g")), ""},
      {"bones.dae",
       collada("", "", "<node name='a'><node name='b'><translate>1 0 0</translate></node></node>"),
       ""},
      {"lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", ""},
      {"empty.stl", "", "the file is empty"},
      {"noise.ply", "not a mesh at all", "cannot be read as a mesh"},
      {"far.obj", "v 0 0 0\nv 1 0 0\nf 1 2 99\n", ""}};
  for (const auto& [name, content, reason] : files) {
    const std::string message = message_of<InputError>(
        [&, &name = name, &content = content] { read_text_as(name, content); });
    EXPECT_THAT(message, testing::AllOf(HasSubstr(name + ": "), HasSubstr(reason))) << name;
  }
}

}  // namespace
}  // namespace nbvopt
