// Maps against the world, voxel by voxel.
#include "nbvopt/sim/map_score.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "sim/box_mesh.hpp"

namespace nbvopt::test {
namespace {

/// A map with occupied voxels that hold these points, each with u = 0.25.
UncertaintyMap map_of(const std::vector<Eigen::Vector3d>& points_m) {
  UncertaintyMap map(0.1);
  for (const Eigen::Vector3d& point_m : points_m) {
    map.set(map.lattice().key(point_m),
            {.state = VoxelState::occupied, .log_odds = 1.0F, .uncertainty = 0.25F});
  }
  map.finish_writing();
  return map;
}

/// A plate about x = 1.045, from 0 to 1 along y and z.
Scene plate() {
  TriangleMesh mesh;
  add_box(mesh, {1.03, 0.0, 0.0}, {1.06, 1.0, 1.0});
  return Scene(mesh);
}

TEST(MapScore, TellsTrueVoxelsFromOthers) {
  // Centres 1.05, 1.15 and 0.95 lie within 0.1 of the plate; 1.25 and 0.85 do not.
  const UncertaintyMap map = map_of({{1.04, 0.55, 0.55},
                                     {1.14, 0.55, 0.55},
                                     {0.96, 0.55, 0.55},
                                     {1.24, 0.55, 0.55},
                                     {0.86, 0.55, 0.55}});
  const MapScore score = score_map(map, map, plate());
  EXPECT_EQ(score.occupied_voxels, 5U);
  EXPECT_DOUBLE_EQ(score.precision, 0.6);
  EXPECT_DOUBLE_EQ(score.recall, 1.0);
  EXPECT_DOUBLE_EQ(score.true_information, 3 * 0.75);
  EXPECT_DOUBLE_EQ(score.shared_information, 5 * 0.75);
}

TEST(MapScore, CountsVoxelsOfPrunedLeaves) {
  std::vector<Eigen::Vector3d> block;
  for (int i = 0; i < 8; ++i) {
    block.emplace_back(1.05 - 0.1 * (i & 1), 0.45 + 0.1 * (i >> 1 & 1), 0.45 + 0.1 * (i >> 2));
  }
  UncertaintyMap map = map_of(block);
  EXPECT_EQ(score_map(map, map, plate()).occupied_voxels, 8U);
}

TEST(MapScore, RecallsWhatIsThereOrBeside) {
  const UncertaintyMap truth =
      map_of({{1.04, 0.15, 0.55}, {1.04, 0.45, 0.55}, {1.04, 0.75, 0.55}, {1.04, 0.95, 0.55}});
  // The same voxel; one beside a face; one beside an edge only; nothing.
  const UncertaintyMap map = map_of({{1.04, 0.15, 0.55}, {1.14, 0.45, 0.55}, {1.14, 0.85, 0.55}});
  const MapScore score = score_map(map, truth, plate());
  EXPECT_DOUBLE_EQ(score.recall, 0.5);
  EXPECT_DOUBLE_EQ(score.shared_information, 0.75) << "the first";
  EXPECT_DOUBLE_EQ(score.precision, 1.0);
}

TEST(MapScore, SaysNothingIllOfAnEmptyMap) {
  const UncertaintyMap empty(0.1);
  const MapScore score = score_map(empty, empty, plate());
  EXPECT_EQ(score.occupied_voxels, 0U);
  EXPECT_EQ(score.precision, 1.0);
  EXPECT_EQ(score.recall, 1.0);
  EXPECT_EQ(score.true_information, 0.0);
}

}  // namespace
}  // namespace nbvopt::test
