// Scans that are put back to where they were taken.
#include "sim/slam/scan_matcher.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "sim/plane_scan.hpp"
#include "sim/slam/ring.hpp"

namespace nbvopt::test {
namespace {

constexpr double kRange_m = 4.0;

std::vector<PlaneBeam> scan_from(const PlanarPose& T_world_base) {
  const Scene scene(ring_mesh());
  return plane_scan(SimulatedLidar(scene, LidarOptions{}),
                    base_pose(T_world_base.x_m, T_world_base.y_m, 0.0, T_world_base.yaw_rad),
                    kRange_m);
}

std::vector<Eigen::Vector2f> hits_from(const PlanarPose& T_world_base) {
  std::vector<Eigen::Vector2f> hits;
  for (const PlaneBeam& beam : scan_from(T_world_base)) {
    if (beam.is_hit) hits.push_back(beam.end_base_m.cast<float>());
  }
  return hits;
}

/// What the lidar tells from there.
TileGrid grid_from(const PlanarPose& T_world_base) {
  std::vector<Beam> beams;
  for (const PlaneBeam& beam : scan_from(T_world_base)) {
    const PlanarPose end = T_world_base * PlanarPose{beam.end_base_m.x(), beam.end_base_m.y(), 0.0};
    beams.push_back({{end.x_m, end.y_m}, beam.is_hit});
  }
  TileGrid grid(0.05);
  grid.insert_scan({T_world_base.x_m, T_world_base.y_m}, beams);
  return grid;
}

TEST(ScanMatcher, RecoversAKnownOffset) {
  const TileGrid grid = grid_from({-3.0, -2.0, 0.3});
  const PlanarPose truth{-2.71, -1.93, 0.62};
  const std::vector<Eigen::Vector2f> hits = hits_from(truth);
  for (const PlanarPose& off : std::vector<PlanarPose>{
           {0.0, 0.0, 0.0}, {0.08, -0.06, 0.05}, {-0.1, 0.05, -0.08}, {0.03, 0.12, 0.1}}) {
    const ScanMatch match = match_scan(grid, hits, truth * off);
    const PlanarPose error = inverse(truth) * match.T_map_base;
    EXPECT_NEAR(error.x_m, 0.0, 0.015) << off.x_m;
    EXPECT_NEAR(error.y_m, 0.0, 0.015) << off.x_m;
    EXPECT_NEAR(error.yaw_rad, 0.0, 0.01) << off.x_m;
    EXPECT_GT(match.score, 0.6 * static_cast<double>(hits.size()));
  }
}

TEST(ScanMatcher, FindsItsOwnScanExactly) {
  const PlanarPose truth{-3.0, -2.0, 0.3};
  const ScanMatch match =
      match_scan(grid_from(truth), hits_from(truth), truth * PlanarPose{0.06, 0.04, -0.03});
  const PlanarPose error = inverse(truth) * match.T_map_base;
  EXPECT_NEAR(error.x_m, 0.0, 0.005);
  EXPECT_NEAR(error.y_m, 0.0, 0.005);
  EXPECT_NEAR(error.yaw_rad, 0.0, 0.005);
}

TEST(ScanMatcher, LikesTheTruthBest) {
  const TileGrid grid = grid_from({-3.0, -2.0, 0.3});
  const PlanarPose truth{-2.71, -1.93, 0.62};
  const std::vector<Eigen::Vector2f> hits = hits_from(truth);
  const ScanMatch near = match_scan(grid, hits, truth);
  const ScanMatch far = match_scan(grid, hits, truth * PlanarPose{1.5, 0.5, 1.0});
  EXPECT_GT(near.score, far.score);
  EXPECT_GT(near.log_likelihood, far.log_likelihood);
}

TEST(ScanMatcher, StaysWhereNothingFits) {
  const PlanarPose guess{1.0, 2.0, 0.5};
  const ScanMatch match = match_scan(TileGrid(0.05), hits_from({-3.0, -2.0, 0.3}), guess);
  EXPECT_EQ(match.T_map_base, guess);
  EXPECT_LT(match.score, 1e-6);
  EXPECT_EQ(match_scan(grid_from({-3.0, -2.0, 0.3}), {}, guess).T_map_base, guess);
}

}  // namespace
}  // namespace nbvopt::test
