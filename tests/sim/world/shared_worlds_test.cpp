// The paper's environments, held against what their README measured.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>

#include "nbvopt/sim/world.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

/// A row of the README's table. Its triangles count those without area, which no ray can meet and
/// we leave out, but no round shapes. Its box is that of visual or of collision geometry.
struct SharedWorld {
  std::string file;
  std::uint64_t models;
  std::uint64_t all_models;
  std::uint64_t readme_triangles;
  std::uint64_t triangles_without_area;
  std::uint64_t spheres;
  std::uint64_t cylinders;
  WorldGeometry readme_box;
  Eigen::Vector3d readme_size_m;
  Eigen::Vector3d visual_size_m;
};

constexpr std::uint64_t kSphereTriangles = 64 * 2 * 31;
constexpr std::uint64_t kCylinderTriangles = 64 * 4;

class SharedWorlds : public testing::TestWithParam<SharedWorld> {};

TEST_P(SharedWorlds, LoadAsTheirReadmeSays) {
  const std::filesystem::path folder = test::shared_dir() / "worlds";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "the worlds of ../shared are not here, so this was not tested";
  }
  const SharedWorld& expected = GetParam();
  const World visual = read_world(folder / expected.file, {});
  const World collision =
      read_world(folder / expected.file, {.geometry = WorldGeometry::collision});
  const Eigen::Vector3d size_m = visual.bounds_m.sizes();
  std::cout << "| " << expected.file << " | " << visual.models << " ("
            << visual.models + visual.nested_models << ") | " << visual.mesh.triangles.size()
            << " | " << size_m.transpose() << " | collision " << collision.mesh.triangles.size()
            << " | " << collision.bounds_m.sizes().transpose() << " |\n";

  EXPECT_EQ(visual.models, expected.models);
  EXPECT_EQ(visual.models + visual.nested_models, expected.all_models);
  EXPECT_EQ(visual.mesh.triangles.size(),
            expected.readme_triangles - expected.triangles_without_area +
                expected.spheres * kSphereTriangles + expected.cylinders * kCylinderTriangles);
  const World& measured = expected.readme_box == WorldGeometry::visual ? visual : collision;
  EXPECT_LT((measured.bounds_m.sizes() - expected.readme_size_m).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((size_m - expected.visual_size_m).cwiseAbs().maxCoeff(), 0.01);
  for (const std::string& warning : visual.warnings) {
    EXPECT_THAT(warning, testing::HasSubstr("invalid inertia"));
  }
}

constexpr auto visual = WorldGeometry::visual;
constexpr auto collision = WorldGeometry::collision;

INSTANTIATE_TEST_SUITE_P(
    Readme, SharedWorlds,
    testing::Values(SharedWorld{"simple_house/worlds/turtlebot3_house.world",
                                2,
                                15,
                                14479,
                                6,
                                0,
                                4,
                                visual,
                                {15.15, 10.70, 2.50},
                                {15.15, 10.70, 2.50}},
                    SharedWorld{"simple_house/worlds/house_with_door.world",
                                3,
                                16,
                                14491,
                                6,
                                0,
                                4,
                                visual,
                                {15.15, 10.70, 2.50},
                                {15.15, 10.70, 2.50}},
                    SharedWorld{"apartment/worlds/small_house.world",
                                87,
                                174,
                                108062,
                                4,
                                2,
                                0,
                                collision,
                                {19.00, 11.40, 3.04},
                                {19.00, 11.40, 3.00}},
                    SharedWorld{"cafe/worlds/cafe.world",
                                7,
                                7,
                                24176,
                                194,
                                0,
                                0,
                                visual,
                                {10.17, 24.41, 2.87},
                                {10.17, 24.41, 2.87}},
                    SharedWorld{"cafe/worlds/cafe_static_closed.world",
                                8,
                                8,
                                24188,
                                194,
                                0,
                                0,
                                visual,
                                {10.17, 24.41, 2.87},
                                {10.17, 24.41, 2.87}},
                    SharedWorld{"warehouse/worlds/small_warehouse.world",
                                26,
                                52,
                                15003,
                                6,
                                0,
                                0,
                                collision,
                                {13.98, 20.91, 10.21},
                                {14.00, 20.92, 10.21}},
                    // Not in the README's table: as small_warehouse, but for a roof of 1428
                    // triangles and its box.
                    SharedWorld{"warehouse/worlds/no_roof_small_warehouse.world",
                                25,
                                50,
                                15003 - 1428,
                                6,
                                0,
                                0,
                                visual,
                                {14.00, 20.92, 10.11},
                                {14.00, 20.92, 10.11}},
                    SharedWorld{"willowgarage/worlds/willowgarage.world",
                                2,
                                2,
                                13841,
                                248,
                                0,
                                0,
                                collision,
                                {58.63, 45.67, 2.84},
                                {58.63, 48.62, 2.84}},
                    SharedWorld{"willowgarage/worlds/willowgarage_closed.world",
                                2,
                                2,
                                13901,
                                248,
                                0,
                                0,
                                collision,
                                {58.63, 46.07, 2.85},
                                {58.63, 48.93, 2.89}}),
    [](const auto& row) { return std::filesystem::path(row.param.file).stem().string(); });

}  // namespace
}  // namespace nbvopt
