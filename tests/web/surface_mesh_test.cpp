#include "web/surface_mesh.hpp"

#include <gmock/gmock.h>

#include <array>
#include <map>
#include <sstream>

#include "map/map_access.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/error_message.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// A face: x, y, z of its voxel, and its normal.
using UnitFace = std::array<int, 4>;
/// The value of each; -1 where there is none.
using UnitFaces = std::map<UnitFace, int>;

/// Takes a set's rectangles apart. Expects that no face is there twice.
UnitFaces apart(const FaceSet& set) {
  UnitFaces faces;
  std::size_t next = 0;
  for (const FaceRectangle& r : set.rectangles) {
    const int axis = axis_of(r.normal);
    for (int v = 0; v < r.height; ++v) {
      for (int u = 0; u < r.width; ++u, ++next) {
        UnitFace face{r.least.x, r.least.y, r.least.z, static_cast<int>(r.normal)};
        face[(axis + 1) % 3] += u;
        face[(axis + 2) % 3] += v;
        const int value = set.values.empty() ? -1 : set.values.at(next);
        EXPECT_TRUE(faces.emplace(face, value).second) << "a face lies in two rectangles";
      }
    }
  }
  EXPECT_EQ(faces.size(), set.faces);
  EXPECT_EQ(set.values.size(), set.values.empty() ? 0 : set.faces);
  return faces;
}

VoxelState state_beside(const UncertaintyMap& map, VoxelKey key, int normal) {
  std::array<int, 3> k{key.x, key.y, key.z};
  k[normal / 2] += normal % 2 == 1 ? 1 : -1;
  if (k[normal / 2] < 0 || k[normal / 2] > 65535) return VoxelState::unknown;
  return map.at(key_at(k[0], k[1], k[2])).state;
}

/// The faces between voxels of two states in a box, by looking at each voxel.
UnitFaces brute_force(const UncertaintyMap& map, const KeyBox& box, VoxelState of,
                      VoxelState towards) {
  UnitFaces faces;
  for_each_key(box, [&](VoxelKey key) {
    const VoxelRecord voxel = map.at(key);
    if (voxel.state != of) return;
    const int value = of == VoxelState::occupied ? static_cast<int>(voxel.uncertainty * 255) : -1;
    for (int normal = 0; normal < 6; ++normal) {
      if (state_beside(map, key, normal) == towards) {
        faces[{key.x, key.y, key.z, normal}] = value;
      }
    }
  });
  return faces;
}

void expect_brute_force(const UncertaintyMap& map, const SurfaceMesh& mesh, const KeyBox& box) {
  EXPECT_EQ(apart(mesh.seen), brute_force(map, box, VoxelState::occupied, VoxelState::free));
  EXPECT_EQ(apart(mesh.backs), brute_force(map, box, VoxelState::occupied, VoxelState::unknown));
  EXPECT_EQ(apart(mesh.frontier), brute_force(map, box, VoxelState::free, VoxelState::unknown));
}

/// A cube of random voxels over the corners of eight bricks.
UncertaintyMap random_map(double clutter, std::uint64_t seed) {
  UncertaintyMap map(0.1);
  std::mt19937_64 random(seed);
  scatter(map, cube(key_from_origin(-9, -7, -8), 17), clutter, random);
  map.finish_writing();
  return map;
}

/// The surfaces of the bricks that meet a box, one after the other.
SurfaceMesh brick_by_brick(const VoxelGrid& grid, const KeyBox& box) {
  SurfaceMesh all;
  detail::bricks_of(box).for_each([&](detail::BrickKey key) {
    const SurfaceMesh brick = brick_surface(detail::MapAccess::table(grid), key);
    for (FaceSet SurfaceMesh::*set :
         {&SurfaceMesh::seen, &SurfaceMesh::backs, &SurfaceMesh::frontier}) {
      const FaceSet& from = brick.*set;
      FaceSet& to = all.*set;
      to.rectangles.insert(to.rectangles.end(), from.rectangles.begin(), from.rectangles.end());
      to.values.insert(to.values.end(), from.values.begin(), from.values.end());
      to.faces += from.faces;
    }
  });
  return all;
}

TEST(SurfaceMesh, HasEachFaceOnceWithItsUncertainty) {
  for (const double clutter : {0.05, 0.5, 0.95}) {
    const UncertaintyMap map = random_map(clutter, 1);
    const KeyBox box = cube(key_from_origin(-10, -10, -10), 21);
    expect_brute_force(map, surface_mesh(map), box);
    expect_brute_force(map, brick_by_brick(*VoxelGrid::whole(map), box), box);
  }
}

TEST(BrickSurface, HasWhatScansHaveChanged) {
  UncertaintyMap map(0.1);
  map.set(key_from_origin(0, 0, 0), occupied(0.5F));
  map.finish_writing();
  // In a block of its own, of which the other bricks were never read.
  const VoxelKey far = key_from_origin(5000, 5000, 5000);
  const VoxelChange change{.key = far, .state = VoxelState::occupied, .uncertainty = 0.25F};
  const auto grid = VoxelGrid::whole(map)->updated(std::vector{change});
  const SurfaceMesh mesh = brick_surface(detail::MapAccess::table(*grid), detail::brick_of(far));
  EXPECT_EQ(mesh.backs.faces, 6U);
  EXPECT_EQ(apart(mesh.backs).at({far.x, far.y, far.z, 0}), 63);
}

TEST(SurfaceMesh, MergesWhatLiesInOnePlane) {
  UncertaintyMap map(0.1);
  const VoxelKey least = key_from_origin(0, 0, 0);
  set_box(map, {least, key_from_origin(31, 31, 0)}, occupied(0.25F));
  map.set(key_from_origin(3, 4, 0), occupied(0.75F));  // a colour of its own
  set_box(map, {key_from_origin(0, 0, 1), key_from_origin(31, 31, 1)}, kFree);
  map.finish_writing();
  const SurfaceMesh mesh = surface_mesh(map);
  ASSERT_EQ(mesh.seen.rectangles.size(), 1U);
  EXPECT_EQ(mesh.seen.rectangles[0], (FaceRectangle{least, FaceNormal::plus_z, 32, 32}));
  EXPECT_EQ(mesh.seen.values[4 * 32 + 3], 191);
  EXPECT_EQ(mesh.seen.values[4 * 32 + 4], 63);
  EXPECT_EQ(mesh.backs.rectangles.size(), 5U);
  EXPECT_EQ(mesh.frontier.rectangles.size(), 5U);
}

TEST(SurfaceMesh, OfABoxHasTheFacesOfItsVoxelsAlone) {
  const UncertaintyMap map = random_map(0.5, 2);
  const KeyBox box{key_from_origin(-4, -3, -8), key_from_origin(2, 5, 0)};
  expect_brute_force(map, surface_mesh(map, box), box);
}

TEST(SurfaceMesh, EndsWhereTheLatticeDoes) {
  UncertaintyMap map(0.1);
  for (const VoxelKey corner : {key_at(0, 0, 0), key_at(65535, 65535, 65535)}) {
    map.set(corner, occupied(0.5F));
  }
  map.finish_writing();
  const SurfaceMesh mesh = surface_mesh(map);
  EXPECT_EQ(mesh.backs.faces, 12U);
  EXPECT_EQ(mesh.seen.faces + mesh.frontier.faces, 0U);
}

TEST(SurfaceMesh, OfNothingIsEmpty) {
  const SurfaceMesh mesh = surface_mesh(UncertaintyMap(0.1));
  EXPECT_EQ(mesh.seen.faces + mesh.backs.faces + mesh.frontier.faces, 0U);
}

TEST(SurfaceMesh, RefusesMoreSpaceThanItCanGoThrough) {
  // All of the lattice is free: eight leaves under the root.
  std::istringstream file(
      "# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n\x55\x55");
  const UncertaintyMap map = read_map(file, "all.bt");
  ASSERT_EQ(map.at(key_at(7, 7, 7)).state, VoxelState::free);
  EXPECT_THAT(message_of<InputError>([&] { surface_mesh(map); }),
              ::testing::HasSubstr("choose a smaller box"));
  EXPECT_EQ(surface_mesh(map, cube(key_at(0, 0, 0), 40)).frontier.faces, 3U * 40 * 40);
}

}  // namespace
}  // namespace nbvopt::test
