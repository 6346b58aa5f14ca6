#include "office_scene.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

constexpr double kResolution_m = 0.1;

class OfficeScene : public testing::Test {
 protected:
  static void SetUpTestSuite() { office_ = new UncertaintyMap(make_office(kResolution_m)); }
  static void TearDownTestSuite() { delete office_; }

  static VoxelState state_at(double x_m, double y_m, double z_m) {
    return office_->at(office_->lattice().key({x_m, y_m, z_m})).state;
  }

  static UncertaintyMap* office_;
};

UncertaintyMap* OfficeScene::office_ = nullptr;

TEST_F(OfficeScene, IsKnownInsideItsWallsAndUnknownOutside) {
  const MapCounts counts = office_->counts();
  EXPECT_EQ(counts.occupied_voxels + counts.free_voxels, 82U * 62U * 28U);
  EXPECT_EQ(state_at(-0.15, 3.0, 1.0), VoxelState::unknown);
  EXPECT_EQ(state_at(4.0, 3.0, 2.75), VoxelState::unknown);
}

TEST_F(OfficeScene, HasWallsFloorAndCeiling) {
  EXPECT_EQ(state_at(0.55, -0.05, 1.0), VoxelState::occupied);
  EXPECT_EQ(state_at(4.65, 5.05, 1.0), VoxelState::free);
  EXPECT_EQ(state_at(4.75, 5.05, 1.0), VoxelState::occupied);
  EXPECT_EQ(state_at(4.85, 5.05, 1.0), VoxelState::free);
  EXPECT_EQ(state_at(1.05, 0.75, -0.05), VoxelState::occupied);
  EXPECT_EQ(state_at(1.05, 0.75, 2.65), VoxelState::occupied);
}

TEST_F(OfficeScene, OpensAtDoorsAndWindows) {
  EXPECT_EQ(state_at(1.95, 1.45, 1.0), VoxelState::free);
  EXPECT_EQ(state_at(1.95, 1.45, 2.15), VoxelState::occupied);
  EXPECT_EQ(state_at(2.55, 6.05, 1.5), VoxelState::free);
  EXPECT_EQ(state_at(2.55, 6.05, 0.5), VoxelState::occupied);
}

TEST_F(OfficeScene, HasRoomUnderItsTables) {
  EXPECT_EQ(state_at(6.45, 3.75, 0.72), VoxelState::occupied);
  EXPECT_EQ(state_at(6.45, 3.75, 0.35), VoxelState::free);
}

TEST_F(OfficeScene, LeavesTheRobotItsWay) {
  for (const Transform& T_map_base : office_stops()) {
    for (const double z_m : {0.05, 0.4, 0.65}) {
      const Eigen::Vector3d p_map_m = T_map_base * Eigen::Vector3d(0.0, 0.0, z_m);
      EXPECT_EQ(state_at(p_map_m.x(), p_map_m.y(), p_map_m.z()), VoxelState::free)
          << p_map_m.transpose();
    }
  }
}

}  // namespace
}  // namespace nbvopt
