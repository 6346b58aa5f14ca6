#include "server/request_handler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nbvopt/map/map_file.hpp"
#include "nbvopt/solver/registry.hpp"
#include "protocol/limit_error.hpp"
#include "protocol/map_messages.hpp"
#include "protocol/plan_messages.hpp"
#include "protocol/pose_messages.hpp"
#include "server/call_status.hpp"
#include "server/server_world.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;
using Clock = StopRule::Clock;

class RequestHandlerTest : public ::testing::Test {
 protected:
  v1::PlanReply plan(const v1::PlanRequest& request, const StopRule& stop = {}) {
    return handler.plan(request, Clock::now(), stop);
  }

  test::TemporaryFolder folder;
  ServerLimits limits{.max_views = 3};
  MapStore store{test::small_robot(), limits, test::small_map(), 1};
  DataFolder data{folder.path()};
  RequestHandler handler{store, nullptr, &data, limits};
};

TEST_F(RequestHandlerTest, PlansAsThePlannerDoes) {
  const auto expected = store.published()->plan(test::small_request(), *make_solver("auto", {}));
  v1::PlanRequest request = to_message(test::small_request());
  request.set_request_id(42);
  const v1::PlanReply reply = plan(request);
  const PlanResult result = from_message(reply);
  EXPECT_EQ(result.joints, expected.joints);
  EXPECT_EQ(result.view, expected.view);
  EXPECT_EQ(result.evaluations, expected.evaluations);
  EXPECT_EQ(result.message, expected.message);
  EXPECT_EQ(reply.request_id(), 42U);
  EXPECT_EQ(reply.counting(), "per_ray");
}

TEST_F(RequestHandlerTest, JudgesByTheGainThatIsAskedFor) {
  EXPECT_EQ(plan(to_message(test::small_request())).gain(), "positive");
  for (const char* gain : {"expected", "positive + 0.5*rear_side_voxel"}) {
    Robot robot = test::small_robot();
    robot.sensor.gain = gain_from_text(gain, "gain");
    const ViewPlanner planner(store.published()->grid(), robot);
    const PlanResult expected = planner.plan(test::small_request());
    v1::PlanRequest request = to_message(test::small_request());
    request.set_gain(gain);
    const v1::PlanReply reply = plan(request);
    EXPECT_EQ(reply.gain(), gain);
    EXPECT_EQ(from_message(reply).joints, expected.joints) << gain;
    EXPECT_EQ(from_message(reply).view, expected.view) << gain;
    EXPECT_EQ(reply.hazards().empty(), gain != std::string("expected"));
    v1::EvaluateRequest views;
    *views.add_views()->mutable_sensor() = to_message(expected.T_map_sensor);
    views.set_gain(gain);
    EXPECT_EQ(from_message(handler.evaluate(views, Clock::now(), {}).gains(0)), expected.view);
  }
  v1::PlanRequest request = to_message(test::small_request());
  request.set_gain("positiv");
  EXPECT_THAT(test::message_of<InputError>([&] { plan(request); }),
              HasSubstr("gain 'positiv' must be"));
  request.set_gain(std::string(1001, '+'));
  EXPECT_THAT(test::message_of<InputError>([&] { plan(request); }), HasSubstr("1001 letters"));
}

TEST_F(RequestHandlerTest, HeedsWhatLimitsAPlan) {
  v1::PlanRequest request = to_message(test::small_request());
  request.set_max_evaluations(20);
  EXPECT_LE(plan(request).evaluations() + plan(request).surrogate_evaluations(), 20);
  request = to_message(test::small_request());
  request.set_time_limit_ms(1e-9);
  EXPECT_EQ(plan(request).status(), v1::PLAN_STATUS_TIME_LIMIT);
  request.set_time_limit_ms(1e300);
  EXPECT_NE(plan(request).status(), v1::PLAN_STATUS_TIME_LIMIT);
  request.set_time_limit_ms(0.0);
  EXPECT_THROW(plan(request), InputError);
  request.clear_time_limit_ms();
  StopRule stop;
  stop.deadline = Clock::now();
  EXPECT_EQ(plan(request, stop).status(), v1::PLAN_STATUS_TIME_LIMIT);
  stop = {};
  stop.cancel.cancel();
  EXPECT_EQ(plan(request, stop).status(), v1::PLAN_STATUS_CANCELLED);
}

TEST_F(RequestHandlerTest, HasALimitOfItsOwn) {
  ServerLimits hasty;
  hasty.max_compute_ms = 1e-9;
  RequestHandler in_a_hurry(store, nullptr, nullptr, hasty);
  v1::PlanRequest request = to_message(test::small_request());
  request.set_time_limit_ms(1e6);
  EXPECT_EQ(in_a_hurry.plan(request, Clock::now(), {}).status(), v1::PLAN_STATUS_TIME_LIMIT);
}

TEST_F(RequestHandlerTest, EvaluatesViews) {
  v1::EvaluateRequest request;
  *request.add_views()->mutable_sensor() = to_message(test::scan_pose(2));
  v1::View::Mounted& mounted = *request.add_views()->mutable_mounted();
  *mounted.mutable_base()->mutable_pose() = to_message(test::small_request().T_map_base);
  *mounted.mutable_joints() = to_message(JointPosition{7.0, 1.4, 0.9});  // limits do not bind
  const v1::EvaluateReply reply = handler.evaluate(request, Clock::now(), {});
  const std::shared_ptr<const ViewPlanner> planner = store.published();
  ASSERT_EQ(reply.gains_size(), 2);
  EXPECT_EQ(from_message(reply.gains(0)), planner->evaluate(test::scan_pose(2)));
  EXPECT_EQ(from_message(reply.gains(1)),
            planner->evaluate(test::small_request().T_map_base *
                              Mast(MastOptions{}).T_base_sensor({7.0, 1.4, 0.9})));
  EXPECT_EQ(reply.map_version(), 1U);
}

TEST_F(RequestHandlerTest, SaysWhichViewIsBad) {
  v1::EvaluateRequest request;
  *request.add_views()->mutable_sensor() = to_message(test::scan_pose(2));
  request.add_views();
  EXPECT_THAT(test::message_of<InputError>([&] { handler.evaluate(request, Clock::now(), {}); }),
              HasSubstr("views[1] is not set"));
  for (int i = 0; i < 2; ++i) request.add_views();
  EXPECT_THAT(test::message_of<LimitError>([&] { handler.evaluate(request, Clock::now(), {}); }),
              HasSubstr("max_views"));
}

TEST_F(RequestHandlerTest, AnswersAllViewsOrNone) {
  v1::EvaluateRequest request;
  *request.add_views()->mutable_sensor() = to_message(test::scan_pose(2));
  StopRule stop;
  stop.deadline = Clock::now();
  EXPECT_THAT(
      test::message_of<RequestError>([&] { handler.evaluate(request, Clock::now(), stop); }),
      HasSubstr("out of time"));
  stop.cancel.cancel();
  EXPECT_THAT(
      test::message_of<RequestError>([&] { handler.evaluate(request, Clock::now(), stop); }),
      HasSubstr("cancelled"));
}

TEST_F(RequestHandlerTest, InsertsPointsAndDepthImages) {
  v1::InsertScanRequest request;
  *request.mutable_sensor() = to_message(test::scan_pose(0));
  *request.mutable_points() = to_message(test::small_scan());
  UncertaintyMap expected = test::small_map();
  const InsertResult inserted =
      insert_scan(expected, test::small_scan(), test::scan_pose(0), store.robot().sensor);
  const v1::InsertScanReply reply = handler.insert_scan(request);
  EXPECT_EQ(reply.map_version(), 2U);
  EXPECT_EQ(reply.durable_version(), 0U);
  EXPECT_EQ(reply.run_id(), handler.run_id());
  EXPECT_NE(handler.run_id(), RequestHandler(store, nullptr, nullptr, limits).run_id());
  EXPECT_EQ(reply.points_used(), inserted.points_used);
  EXPECT_EQ(reply.rays_cleared(), inserted.rays_cleared);
  EXPECT_EQ(reply.points_too_near(), inserted.points_too_near);
  EXPECT_EQ(reply.points_too_far(), inserted.points_too_far);
  EXPECT_EQ(reply.no_returns(), inserted.no_returns);
  EXPECT_EQ(reply.points_not_finite(), inserted.points_not_finite);
  EXPECT_EQ(reply.points_off_lattice(), inserted.points_off_lattice);
  EXPECT_EQ(reply.voxels_changed(), inserted.changes.size());
  EXPECT_EQ(reply.information_gained(), inserted.information_gained);
  EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot)->bytes.joined(),
            map_file_bytes(expected, MapFormat::uncertainty_ot));
}

TEST_F(RequestHandlerTest, LoadsAndSavesMaps) {
  v1::SaveMapRequest save;
  save.set_path("saved.ot");
  handler.save_map(save);
  EXPECT_EQ(map_file_bytes(read_map(std::filesystem::path(folder / "saved.ot")),
                           MapFormat::uncertainty_ot),
            store.bytes(MapFormat::uncertainty_ot)->bytes.joined());
  const std::string before = store.bytes(MapFormat::uncertainty_ot)->bytes.joined();
  handler.clear_map({});
  v1::LoadMapRequest load;
  load.set_path("saved.ot");
  const v1::LoadMapReply loaded = handler.load_map(load);
  EXPECT_EQ(loaded.map_version(), 3U);
  EXPECT_EQ(loaded.resolution_m(), 0.1);
  EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot)->bytes.joined(), before);
  EXPECT_EQ(handler.get_map({})->bytes.joined(), before);
}

TEST_F(RequestHandlerTest, RefusesMapsWhileOthersHoldTooMuchOfOlderOnes) {
  limits.max_pinned_mib = 1;
  const RequestHandler strict(store, nullptr, nullptr, limits);
  const auto insert_finely = [this] {
    store.clear(0.01);
    store.insert(test::small_scan(), test::scan_pose(0));
  };
  insert_finely();
  std::vector<std::shared_ptr<const MapBytes>> held;
  EXPECT_THAT(test::message_of<RequestError>([&] {
                for (int i = 0; i < 20; ++i, insert_finely()) held.push_back(strict.get_map({}));
              }),
              HasSubstr("the limit is 1 MiB (max_pinned_mib)"));
  EXPECT_FALSE(held.empty());
  EXPECT_GT(store.pinned_bytes(), 1U << 20);
  store.insert(test::small_scan(), test::scan_pose(1));  // scans go on, and snapshots
  EXPECT_GT(store.bytes(MapFormat::uncertainty_ot)->version, held.back()->version);
  held.clear();
  EXPECT_EQ(store.pinned_bytes(), 0U);
  EXPECT_GT(strict.get_map({})->bytes.size(), 0U);
}

TEST_F(RequestHandlerTest, KeepsItsMapWhenAFileCannotBeRead) {
  folder.write("bad.ot", "not a map");
  v1::LoadMapRequest load;
  EXPECT_THROW(handler.load_map(load), InputError);
  load.set_path("bad.ot");
  EXPECT_THAT(test::message_of<InputError>([&] { handler.load_map(load); }),
              HasSubstr("'bad.ot': this is not an OctoMap file"));
  load.set_path("none.ot");
  EXPECT_THROW(handler.load_map(load), RequestError);
  EXPECT_EQ(store.published()->map_version(), 1U);
  RequestHandler without(store, nullptr, nullptr, limits);
  EXPECT_THAT(test::message_of<RequestError>([&] { without.load_map(load); }),
              HasSubstr("no data folder"));
}

TEST_F(RequestHandlerTest, TellsItsStatus) {
  v1::GetStatusRequest request;
  EXPECT_FALSE(handler.status(request).has_counts());
  request.set_with_counts(true);
  const v1::GetStatusReply reply = handler.status(request);
  EXPECT_EQ(reply.map_version(), 1U);
  EXPECT_EQ(reply.counted_version(), 1U);
  EXPECT_EQ(reply.counts().occupied_voxels(), 200U);
  EXPECT_EQ(reply.counts().information(), 100.0);
  EXPECT_EQ(reply.counts().paper_voxels(), test::small_map().paper_counts().voxels);
  EXPECT_EQ(reply.resolution_m(), 0.1);
  EXPECT_THAT(reply.versions(), HasSubstr("gRPC"));
}

TEST_F(RequestHandlerTest, TellsWhatItHasDone) {
  v1::InsertScanRequest scan;
  *scan.mutable_sensor() = to_message(test::scan_pose(0));
  *scan.mutable_points() = to_message(test::small_scan());
  const v1::InsertScanReply inserted = handler.insert_scan(scan);
  handler.insert_scan(scan);
  v1::PlanRequest limited = to_message(test::small_request());
  limited.set_max_evaluations(20);
  const v1::PlanReply planned = plan(limited);
  const v1::GetStatusReply reply = handler.status({});
  EXPECT_EQ(reply.scan_totals().points_used(), 2 * inserted.points_used());
  EXPECT_EQ(reply.scan_totals().points_ignored(), 2 * inserted.points_ignored());
  EXPECT_GE(reply.scan_totals().voxels_changed(), inserted.voxels_changed());
  EXPECT_GE(reply.scan_totals().information_gained(), inserted.information_gained());
  for (const v1::PlanCount& count : reply.plans()) {
    EXPECT_EQ(count.plans(), count.status() == planned.status() ? 1U : 0U);
  }
  EXPECT_EQ(reply.plans_size(), 7);
  EXPECT_GT(reply.map_bytes(), 1000U);
  EXPECT_EQ(reply.hazards_size(), 0);  // the gain is not expected
  EXPECT_EQ(reply.limits_size(), 15);
  EXPECT_EQ(reply.limits(2).name(), "max_views");
  EXPECT_EQ(reply.limits(2).value(), 3.0);
}

TEST(RequestHandler, TellsWhatItsScansTaught) {
  Robot robot = test::small_robot();
  robot.sensor.gain = GainKind::expected;
  MapStore store(robot, {}, test::small_map(), 1);
  RequestHandler handler(store, nullptr, nullptr, {});
  const double before = HazardTable().total().metres;
  v1::InsertScanRequest scan;
  const Transform T_map_base = base_pose(0.0, 0.0, 0.0, 3.0);  // away from the wall that is known
  *scan.mutable_sensor() = to_message(T_map_base * test::scan_pose(0));
  *scan.mutable_points() = to_message(test::small_scan());
  handler.insert_scan(scan);
  const v1::GetStatusReply reply = handler.status({});
  double metres = 0.0;
  for (const v1::HazardCount& count : reply.hazards()) metres += count.metres();
  EXPECT_GT(metres, before);
  EXPECT_NEAR(metres, store.published()->hazards().total().metres, 1e-9);
}

}  // namespace
}  // namespace nbvopt
