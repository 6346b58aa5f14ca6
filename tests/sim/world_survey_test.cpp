// Floors and free places of worlds.
#include "nbvopt/sim/world_survey.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "sim/box_mesh.hpp"

namespace nbvopt {
namespace {

Eigen::AlignedBox3d surveyed_bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d bounds_m;
  for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) bounds_m.extend(vertex_m.cast<double>());
  return bounds_m;
}

WorldSurvey survey_of(const TriangleMesh& mesh, const ExplorationOptions& options = {}) {
  return survey_world(Scene(mesh), surveyed_bounds(mesh), options);
}

/// A house of 8 x 6 m whose slabs, 0.2 m thick, have these tops, with walls between them.
TriangleMesh house(const std::vector<double>& slabs_m) {
  TriangleMesh mesh;
  for (const double z : slabs_m) test::add_box(mesh, {0, 0, z - 0.2}, {8, 6, z});
  const double top = slabs_m.back() - 0.2;
  const double bottom = slabs_m.front();
  test::add_box(mesh, {0, 0, bottom}, {8, 0.1, top});
  test::add_box(mesh, {0, 5.9, bottom}, {8, 6, top});
  test::add_box(mesh, {0, 0, bottom}, {0.1, 6, top});
  test::add_box(mesh, {7.9, 0, bottom}, {8, 6, top});
  return mesh;
}

TEST(WorldSurvey, ListsFloorsFromBelowAndStartsOnTheLowestNotOnTheRoof) {
  const WorldSurvey survey = survey_of(house({0.0, 3.0, 6.0}));
  ASSERT_EQ(survey.floors.size(), 3U);
  EXPECT_NEAR(survey.floors[0].height_m, 0.0, 1e-3);
  EXPECT_NEAR(survey.floors[1].height_m, 3.0, 1e-3);
  EXPECT_NEAR(survey.floors[2].height_m, 6.0, 1e-3);
  EXPECT_NEAR(survey.floors[0].area_m2, 7.3 * 5.3, 3.0);
  ASSERT_EQ(survey.starts.size(), 7U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(survey.starts[i].position_map_m.z(), 0.0, 1e-3) << i;
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE((survey.starts[i].position_map_m - survey.starts[k].position_map_m).norm(), 2.0);
    }
  }
  EXPECT_NEAR(survey.starts[0].room_m, 2.9, 0.3);  // in the middle between the long walls
  EXPECT_NEAR(survey.starts[5].position_map_m.z(), 3.0, 1e-3);
}

TEST(WorldSurvey, StartsOnTheFloorOfAHouseWhoseRoofIsWider) {
  TriangleMesh mesh = house({0.0});
  test::add_box(mesh, {-5, -5, 2.5}, {13, 11, 2.6});
  test::add_box(mesh, {0, 0, 0}, {8, 0.1, 2.5});
  test::add_box(mesh, {0, 5.9, 0}, {8, 6, 2.5});
  EXPECT_NEAR(survey_of(mesh).starts.at(0).position_map_m.z(), 0.0, 1e-3);
}

TEST(WorldSurvey, StartsNeitherInFurnitureNorInSolids) {
  TriangleMesh mesh = house({0.0, 3.0});
  test::add_box(mesh, {1.0, 1.0, 0.0}, {4.0, 5.0, 2.5});  // of 30 m3: as a room, seen from within
  const WorldSurvey survey = survey_of(mesh);
  ASSERT_FALSE(survey.starts.empty());
  EXPECT_GT(survey.starts.front().position_map_m.x(), 4.0);
  EXPECT_LT(survey.starts.front().position_map_m.x(), 7.9);
}

TEST(WorldSurvey, FindsNoPlaceWhereThereIsNone) {
  TriangleMesh crate;
  test::add_box(crate, {0, 0, 0}, {0.3, 0.3, 0.3});
  EXPECT_TRUE(survey_of(crate).starts.empty());
}

TEST(WorldSurvey, StaysInTheRegion) {
  ExplorationOptions options;
  options.region_map_m = {{5, 3}, {8, 3}, {8, 6}, {5, 6}};
  const WorldSurvey survey = survey_of(house({0.0, 3.0}), options);
  ASSERT_FALSE(survey.starts.empty());
  for (const StartPlace& start : survey.starts) {
    EXPECT_GT(start.position_map_m.x(), 5.0);
    EXPECT_GT(start.position_map_m.y(), 3.0);
  }
}

TEST(WorldSurvey, LooksAboutTheOriginWhereThereArePlanesOnly) {
  TriangleMesh plane;
  test::add_box(plane, {-50, -50, -0.1}, {50, 50, 0});
  const WorldSurvey survey = survey_world(Scene(plane), {}, {});
  ASSERT_FALSE(survey.starts.empty());
  EXPECT_LT(survey.starts.front().position_map_m.head<2>().norm(), 8.0);
}

}  // namespace
}  // namespace nbvopt
