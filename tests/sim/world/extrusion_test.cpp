// Outlines drawn out into solids.
#include "sim/world/extrusion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

const Outline kSquare{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const Outline kHole{{1, 1}, {1, 3}, {3, 3}, {3, 1}};
const Outline kStar{{0, 3}, {1.8, -2.4}, {-2.9, 0.9}, {2.9, 0.9}, {-1.8, -2.4}};
const Outline kBay{{0, 0}, {5, 0}, {5, 4}, {2, 1}, {0, 4}};

/// By the divergence theorem: right only where all triangles face outwards.
double volume_m3(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += mesh.vertices_m[a].cast<double>().dot(
               mesh.vertices_m[b].cast<double>().cross(mesh.vertices_m[c].cast<double>())) /
           6.0;
  }
  return sum;
}

using Point = std::array<float, 3>;

/// How many triangles meet at an edge, each edge with its corners in order.
std::map<std::pair<Point, Point>, int> edge_counts(const TriangleMesh& mesh) {
  std::map<std::pair<Point, Point>, int> counts;
  const auto point = [&](std::uint32_t i) {
    const Eigen::Vector3f& v = mesh.vertices_m[i];
    return Point{v.x(), v.y(), v.z()};
  };
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = point(triangle[i]);
      const Point to = point(triangle[(i + 1) % 3]);
      if (from != to) ++counts[std::minmax(from, to)];
    }
  }
  return counts;
}

TEST(Extrusion, HasTheVolumeOfItsSection) {
  EXPECT_NEAR(volume_m3(extruded_mesh({kSquare}, 2.5)), 40.0, 1e-4);
  EXPECT_NEAR(volume_m3(extruded_mesh({kSquare, kHole}, 2.5)), 30.0, 1e-4);
  EXPECT_NEAR(volume_m3(extruded_mesh({kHole, kSquare}, 2.5)), 30.0, 1e-4);
  EXPECT_NEAR(volume_m3(extruded_mesh({kBay}, 1.0)), 20.0 - 7.5, 1e-4);
  Outline closed = kSquare;
  closed.push_back(kSquare.front());
  EXPECT_NEAR(volume_m3(extruded_mesh({closed}, 2.5)), 40.0, 1e-4);
}

TEST(Extrusion, IsClosedSoThatNoRaySlipsThrough) {
  for (const auto& outlines : std::vector<std::vector<Outline>>{
           {kSquare}, {kSquare, kHole}, {kBay}, {{{0, 0}, {3, 1}, {1, 4}}}}) {
    for (const auto& [edge, count] : edge_counts(extruded_mesh(outlines, 1.0))) {
      EXPECT_EQ(count % 2, 0) << edge.first[0] << ' ' << edge.first[1] << ' ' << edge.first[2];
    }
  }
}

TEST(Extrusion, LeavesOutWhatIsInsideTwice) {
  // The star's middle is inside of its outline twice: an even number is outside.
  const TriangleMesh star = extruded_mesh({kStar}, 1.0);
  double nearest_m = 10.0;
  for (const Eigen::Vector3f& vertex : star.vertices_m) {
    nearest_m = std::min(nearest_m, static_cast<double>(vertex.head<2>().norm()));
  }
  EXPECT_GT(nearest_m, 0.8);
}

TEST(Extrusion, RefusesWhatIsNoOutline) {
  EXPECT_THAT(test::message_of<InputError>([] {
                extruded_mesh({{{0, 0}, {1, 0}}}, 1.0);
              }),
              testing::HasSubstr("fewer than 3 points"));
  EXPECT_THAT(test::message_of<InputError>([] {
                Outline zigzag;
                for (int i = 0; i < 1200; ++i) zigzag.emplace_back(i, i % 2);
                extruded_mesh({zigzag}, 1.0);
              }),
              testing::HasSubstr("more than 1000 points"));
}

TEST(Extrusion, IsBuiltFromPolylines) {
  const test::WorldFolder folder;
  const auto path = folder.add_world(
      "<model name='m'>" +
      test::link_with("<polyline><point>0 0</point><point>4 0</point><point>4 4</point><point>0 4"
                      "</point><height>2.5</height></polyline><polyline><point>1 1</point>"
                      "<point>1 3</point><point>3 3</point><point>3 1</point></polyline>",
                      "10 0 0 0 0 0") +
      "</model>");
  const World world = read_world(path, {.is_strict = true});
  EXPECT_NEAR(volume_m3(world.mesh), 30.0, 1e-3);
  EXPECT_TRUE(world.bounds_m.min().isApprox(Eigen::Vector3d(10, 0, 0)));
  EXPECT_TRUE(world.bounds_m.max().isApprox(Eigen::Vector3d(14, 4, 2.5)));
}

}  // namespace
}  // namespace nbvopt
