#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "nbvopt/core/error.hpp"
#include "protocol/limit_error.hpp"
#include "protocol/map_messages.hpp"
#include "protocol/plan_messages.hpp"
#include "protocol/pose_messages.hpp"
#include "server/server_world.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kNaN;
using ::testing::HasSubstr;
constexpr std::uint64_t kMaxPoints = 100'000;

TEST(Messages, KeepAPoseToTheLastBit) {
  const Transform T = test::scan_pose(13);
  const Transform same = from_message(to_message(T), "pose");
  EXPECT_EQ(same.matrix(), T.matrix());
  v1::Pose quaternion_only = to_message(T);
  quaternion_only.clear_rotation();
  EXPECT_TRUE(from_message(quaternion_only, "pose").isApprox(T, 1e-14));
}

TEST(Messages, KeepAPlanRequest) {
  PlanRequest request = test::small_request();
  request.base_twist = {0.1, 0.2, 0.3};
  request.base_path = {{0.5, test::scan_pose(5)}};
  request.min_gain = 2.5;
  request.seed = 77;
  request.stop.max_evaluations = 99;
  const PlanRequest same = from_message(to_message(request));
  EXPECT_EQ(same.T_map_base.matrix(), request.T_map_base.matrix());
  EXPECT_EQ(same.joints, request.joints);
  EXPECT_EQ(same.motion_time_s, request.motion_time_s);
  EXPECT_EQ(same.base_twist, request.base_twist);
  ASSERT_EQ(same.base_path.size(), 1U);
  EXPECT_EQ(same.base_path[0].time_s, 0.5);
  EXPECT_EQ(same.base_path[0].T_map_base.matrix(), test::scan_pose(5).matrix());
  EXPECT_EQ(same.min_gain, 2.5);
  EXPECT_EQ(same.seed, 77U);
  EXPECT_EQ(same.stop.max_evaluations, 99);
}

TEST(Messages, KeepAnAnswer) {
  PlanResult result;
  result.status = PlanStatus::time_limit;
  result.message = "move";
  result.joints = {1.0, 0.5, 0.3};
  result.T_map_sensor = test::scan_pose(3);
  result.T_map_base = test::scan_pose(4);
  result.view = {10.0, 7.0, 3.0, 5, 6, 7};
  result.current = {1.0, 0.5, 0.5, 1, 2, 3};
  result.move_time_s = 0.4;
  result.box = {.min = {0, 1, 2}, .max = {3, 4, 5}};
  result.active_bounds = {"tilt_min"};
  result.hazards = HazardTable::uniform(0.25);
  result.certificate = {
      .upper_bound = 20.0, .gain = 19.0, .cones = 7, .improvements = 1, .time_ms = 2.0};
  result.evaluations = 12;
  result.surrogate_evaluations = 34;
  result.search_time_ms = 5.5;
  result.solver = "auto";
  result.seed = 9;
  result.map_version = 8;
  result.warnings = {"a", "b"};
  const PlanResult same = from_message(to_message(result));
  EXPECT_EQ(same.status, result.status);
  EXPECT_EQ(same.message, result.message);
  EXPECT_EQ(same.joints, result.joints);
  EXPECT_EQ(same.T_map_sensor.matrix(), result.T_map_sensor.matrix());
  EXPECT_EQ(same.T_map_base.matrix(), result.T_map_base.matrix());
  EXPECT_EQ(same.view, result.view);
  EXPECT_EQ(same.current, result.current);
  EXPECT_EQ(same.move_time_s, result.move_time_s);
  EXPECT_EQ(same.box.min, result.box.min);
  EXPECT_EQ(same.box.max, result.box.max);
  EXPECT_EQ(same.active_bounds, result.active_bounds);
  EXPECT_EQ(same.hazards, result.hazards);
  EXPECT_EQ(same.certificate, result.certificate);
  EXPECT_EQ(same.evaluations, result.evaluations);
  EXPECT_EQ(same.surrogate_evaluations, result.surrogate_evaluations);
  EXPECT_EQ(same.search_time_ms, result.search_time_ms);
  EXPECT_EQ(same.solver, result.solver);
  EXPECT_EQ(same.seed, result.seed);
  EXPECT_EQ(same.map_version, result.map_version);
  EXPECT_EQ(same.warnings, result.warnings);
}

TEST(Messages, KeepASearch) {
  for (const Search& search :
       {Search{}, Search{.solver = "grid", .grid_steps = {0.8, 0.0, 0.1}},
        Search{.stages = StrategyOptions{}},
        Search{.stages = StrategyOptions{.global = "", .polish = "nlopt:sbplx"}}}) {
    EXPECT_EQ(from_message(to_message(search)), search);
  }
}

TEST(Messages, TakeStagesThatAreNotNamedFromAuto) {
  v1::Search message;
  message.set_local("none");
  EXPECT_EQ(from_message(message), (Search{.stages = StrategyOptions{.local = ""}}));
  message.set_polish("");
  EXPECT_THAT(test::message_of<UsageError>([&] { from_message(message); }),
              HasSubstr("polish stage is empty"));
}

TEST(Messages, RefuseASearchThatAServerCannotBeTold) {
  EXPECT_THROW(to_message(Search{.solver = "nlopt:sbplx", .tolerance = 0.1}), InputError);
  EXPECT_THROW(to_message(Search{.stages = StrategyOptions{.local_starts = 9}}), InputError);
}

TEST(Messages, KeepAScan) {
  Scan scan = test::small_scan();
  scan.colours.assign(scan.points_m.size(), {1, 2, 3});
  scan.points_m.front().x() = std::numeric_limits<float>::infinity();
  v1::InsertScanRequest request;
  *request.mutable_points() = to_message(scan);
  const Scan same = scan_from_message(request, kMaxPoints);
  EXPECT_EQ(same.points_m, scan.points_m);
  EXPECT_EQ(same.no_returns, scan.no_returns);
  EXPECT_EQ(same.colours, scan.colours);
}

TEST(Messages, TurnADepthImageIntoPoints) {
  v1::InsertScanRequest request;
  v1::DepthImage& image = *request.mutable_depth_image();
  image.set_width_px(2);
  image.set_height_px(2);
  const std::array<std::uint16_t, 4> depths{1000, 0, 65535, 2000};
  image.set_depth(std::string(reinterpret_cast<const char*>(depths.data()), sizeof depths));
  image.set_fx_px(2.0);
  image.set_fy_px(4.0);
  image.set_cx_px(0.0);
  image.set_cy_px(0.0);
  const Scan scan = scan_from_message(request, kMaxPoints);
  ASSERT_EQ(scan.points_m.size(), 2U);
  EXPECT_EQ(scan.points_m[0], Eigen::Vector3f(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(scan.points_m[1], Eigen::Vector3f(1.0F, 0.5F, 2.0F));
  ASSERT_EQ(scan.no_returns.size(), 1U);
  EXPECT_EQ(scan.no_returns[0], Eigen::Vector3f(0.0F, 0.25F, 1.0F));
}

struct BadPlan {
  std::function<void(v1::PlanRequest&)> spoil;
  std::string expected;
};

TEST(Messages, NameWhatAPlanLacks) {
  const std::vector<BadPlan> cases{
      {[](auto& r) { r.clear_base(); }, "base is not set"},
      {[](auto& r) { r.mutable_base()->mutable_planar(); }, "base.planar.x_m is not set"},
      {[](auto& r) { r.mutable_base()->mutable_pose()->clear_z_m(); }, "base.pose.z_m is not set"},
      {[](auto& r) { r.mutable_base()->mutable_pose()->set_x_m(kNaN); }, "base.pose.x_m is nan"},
      {[](auto& r) { r.mutable_base()->mutable_pose()->add_rotation(1); }, "rotation has 10"},
      {[](auto& r) { r.mutable_base()->mutable_pose()->set_rotation(0, 2); }, "not a rotation"},
      {[](auto& r) { r.mutable_base()->mutable_pose()->set_rotation(0, kNaN); }, "not a rotation"},
      {[](auto& r) {
         auto& pose = *r.mutable_base()->mutable_pose();
         pose.clear_rotation();
         pose.clear_qw();
       },
       "base.pose.qw is not set"},
      {[](auto& r) {
         auto& pose = *r.mutable_base()->mutable_pose();
         pose.clear_rotation();
         pose.set_qx(0), pose.set_qy(0), pose.set_qz(0), pose.set_qw(0);
       },
       "base.pose: "},
      {[](auto& r) { r.clear_joints(); }, "joints.pan_rad is not set"},
      {[](auto& r) { r.mutable_joints()->clear_tilt_rad(); }, "joints.tilt_rad is not set"},
      {[](auto& r) { r.mutable_joints()->set_height_m(kNaN); }, "joints.height_m is nan"},
      {[](auto& r) { r.clear_motion_time_s(); }, "motion_time_s is not set"},
      {[](auto& r) { r.set_motion_time_s(kNaN); }, "motion_time_s is nan"},
      {[](auto& r) { r.mutable_base_twist()->set_vx_m_s(1); }, "base_twist.vy_m_s is not set"},
      {[](auto& r) { *r.add_base_path()->mutable_base() = r.base(); },
       "base_path[0].time_s is not set"},
      {[](auto& r) { r.add_base_path()->set_time_s(1); }, "base_path[0].base"},
      {[](auto& r) { r.set_min_gain(kNaN); }, "min_gain is nan"},
      {[](auto& r) { r.set_max_evaluations(0); }, "max_evaluations is 0"},
  };
  for (const BadPlan& bad : cases) {
    v1::PlanRequest request = to_message(test::small_request());
    bad.spoil(request);
    EXPECT_THAT(test::message_of<InputError>([&] { from_message(request); }),
                HasSubstr(bad.expected));
  }
}

struct BadScan {
  std::function<void(v1::InsertScanRequest&)> spoil;
  std::string expected;
};

TEST(Messages, NameWhatAScanLacks) {
  const std::vector<BadScan> cases{
      {[](auto& r) { r.clear_scan(); }, "scan is not set"},
      {[](auto& r) { r.mutable_points()->mutable_xyz_m()->pop_back(); }, "cut short"},
      {[](auto& r) { r.mutable_points()->set_no_return_xyz("12345"); }, "cut short"},
      {[](auto& r) { r.mutable_points()->set_rgb("12"); }, "3 a point"},
      {[](auto& r) { r.mutable_depth_image(); }, "width_px is not set"},
      {[](auto& r) { r.mutable_depth_image()->set_width_px(3); }, "height_px is not set"},
      {[](auto& r) {
         r.mutable_depth_image()->set_width_px(3);
         r.mutable_depth_image()->set_height_px(2);
         r.mutable_depth_image()->set_depth("half");
       },
       "3 x 2 pixels take 12"},
      {[](auto& r) {
         r.mutable_depth_image()->set_width_px(0);
         r.mutable_depth_image()->set_height_px(2);
       },
       "no pixels"},
      {[](auto& r) {
         r.mutable_depth_image()->set_width_px(1);
         r.mutable_depth_image()->set_height_px(1);
         r.mutable_depth_image()->set_depth("ab");
       },
       "fx_px is not set"},
  };
  for (const BadScan& bad : cases) {
    v1::InsertScanRequest request;
    *request.mutable_points() = to_message(test::small_scan());
    bad.spoil(request);
    EXPECT_THAT(test::message_of<InputError>([&] { scan_from_message(request, kMaxPoints); }),
                HasSubstr(bad.expected));
  }
}

TEST(Messages, RefuseScansBeyondTheLimit) {
  v1::InsertScanRequest request;
  *request.mutable_points() = to_message(test::small_scan());
  EXPECT_THAT(test::message_of<LimitError>([&] { scan_from_message(request, 1270); }),
              HasSubstr("max_scan_points"));
  EXPECT_EQ(test::message_of<LimitError>([&] { scan_from_message(request, 1271); }), "");
  request.mutable_depth_image()->set_width_px(0xFFFFFFFF);
  request.mutable_depth_image()->set_height_px(0xFFFFFFFF);
  EXPECT_THAT(test::message_of<LimitError>([&] { scan_from_message(request, 1270); }),
              HasSubstr("max_scan_points"));
}

}  // namespace
}  // namespace nbvopt
