#include "server/web/live_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.hpp"
#include "server/web/event_stream.hpp"
#include "server/web/live_world.hpp"
#include "support/wait_until.hpp"
#include "web/answer_json.hpp"
#include "web/view_gains.hpp"

namespace nbvopt {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class LivePageTest : public ::testing::Test {
 protected:
  Json state() const { return parse_json(page.state(), "state"); }

  test::LiveWorld world;
  LivePage page{world.sources()};
};

TEST_F(LivePageTest, TellsTheNewestMapAndPlan) {
  EXPECT_EQ(state()["map"], "7-1");
  EXPECT_EQ(state()["plan"], 0);
  EXPECT_FALSE(state().contains("answer"));
  world.scan();
  world.plan("first");
  world.plan("second");
  EXPECT_EQ(state()["map"], "7-2");
  EXPECT_EQ(state()["map_version"], 2);
  EXPECT_EQ(state()["plan"], 2);
  const Json answer = state()["answer"];
  const PlanResult& plan = *world.plans.newest().plan;
  EXPECT_THAT(answer["why"].get<std::string>(), EndsWith("second"));
  EXPECT_EQ(answer["chosen"]["gain"], plan.view.gain);
  EXPECT_EQ(answer["current"]["joints"]["pan_rad"], plan.request.joints.pan_rad);
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(answer["chosen"]["T_map_sensor"][i], plan.T_map_sensor.matrix().data()[i], 1e-12);
  }
}

TEST_F(LivePageTest, KeepsTextsOnOneLine) {
  world.plan("a\n\ndata: b\r</script>\xff");
  EXPECT_THAT(page.state(), Not(HasSubstr("\n")));
  EXPECT_THAT(page.state(), Not(HasSubstr("\r")));
  EXPECT_THAT(state()["answer"]["why"].get<std::string>(),
              EndsWith("\n\ndata: b\r</script>\ufffd"));
}

/// What a reader of `since` is told.
Json map_of(LivePage& page, const std::string& since = "") {
  return parse_json(page.map(since).joined(), "map");
}

TEST_F(LivePageTest, MakesAMapOnceForAllWhoAsk) {
  LivePage seldom(world.sources(), std::chrono::hours(1));
  const Json first = map_of(seldom);
  EXPECT_EQ(first["id"], "7-1");
  EXPECT_EQ(first["is_whole"], true);
  EXPECT_EQ(first["map"]["occupied_voxels"], 200);
  EXPECT_FALSE(first["bricks"].empty());
  // All who ask share the bricks.
  EXPECT_EQ(seldom.map().pieces()[1], seldom.map().pieces()[1]);
  world.scan();
  EXPECT_EQ(map_of(seldom), first);  // it is too early for another
}

TEST_F(LivePageTest, TellsAReaderWhatItLacks) {
  LivePage often(world.sources(), std::chrono::milliseconds(0));
  const LivePage::Reader reader(often);
  const Json first = map_of(often);
  EXPECT_EQ(map_of(often, "7-1")["bricks"], Json::object());
  world.scan();
  Json next;
  EXPECT_TRUE(test::wait_until([&] {
    next = map_of(often, "7-1");
    return next["id"] == "7-2";
  }));
  EXPECT_EQ(next["is_whole"], false);
  EXPECT_FALSE(next["bricks"].empty());
  EXPECT_LT(next["bricks"].size(), map_of(often)["bricks"].size());
  EXPECT_EQ(map_of(often, "7-2")["bricks"], Json::object());
}

TEST_F(LivePageTest, TellsAllToAReaderOfAnythingElse) {
  map_of(page);
  for (const char* since :
       {"", "6-1", "7-", "7-2", "7--1", "7-1x", "7-99999999999999999999", "1", "</script>"}) {
    const Json all = map_of(page, since);
    EXPECT_EQ(all["is_whole"], true) << since;
    EXPECT_FALSE(all["bricks"].empty()) << since;
  }
}

TEST_F(LivePageTest, KeepsAGridForReadersAlone) {
  LivePage often(world.sources(), std::chrono::milliseconds(0));
  const auto grid = [&] { return std::weak_ptr(world.store.published()->grid()); };
  const std::weak_ptr<const VoxelGrid> first = grid();
  map_of(often);
  world.scan();
  EXPECT_TRUE(first.expired());
  const std::weak_ptr<const VoxelGrid> second = grid();
  {
    const LivePage::Reader reader(often);
    EXPECT_TRUE(test::wait_until([&] { return map_of(often)["id"] == "7-2"; }));
    world.scan();
    EXPECT_FALSE(second.expired());
  }
  EXPECT_TRUE(second.expired());
}

class LiveGainsTest : public LivePageTest {
 protected:
  static Json told(LiveGains& gains) { return parse_json(*gains.newest(), "gains"); }
};

TEST_F(LiveGainsTest, TellsWhatViewsAndVoxelsGainAroundTheNewestPlan) {
  LiveGains gains(world.sources(), std::chrono::milliseconds(0));
  EXPECT_EQ(told(gains), Json({{"plan", 0}}));
  world.plan("first");
  const auto first = gains.newest();
  EXPECT_EQ(gains.newest(), first);  // once for all who ask
  const Json json = parse_json(*first, "gains");
  const auto planner = world.store.published();
  const AnswerFile answer = answer_of(*world.plans.newest().plan);
  const ViewGains expected = view_gains(answer, *planner);
  EXPECT_EQ(json["plan"], 1);
  EXPECT_EQ(json["map_version"], 1);
  EXPECT_EQ(json["answer"]["chosen"]["gain"], answer.gain);
  EXPECT_EQ(json["landscape"], expected.data["landscape"]);
  ASSERT_EQ(expected.blocks.size(), 2U);
  for (const PageBlock& block : expected.blocks) EXPECT_EQ(json["blocks"][block.id], block.base64);
}

TEST_F(LiveGainsTest, JudgesByThePlansGain) {
  LiveGains gains(world.sources(), std::chrono::milliseconds(0));
  world.plan("first", GainKind::average_entropy);
  EXPECT_THAT(told(gains)["voxel_gains"]["why_none"].get<std::string>(),
              HasSubstr("average_entropy is no sum over voxels"));
  EXPECT_FALSE(told(gains)["blocks"].contains("voxel-gains"));
}

TEST_F(LiveGainsTest, LeavesOutWhatTakesTooLongAndMakesNothingTooOften) {
  LiveGains gains(world.sources(), std::chrono::hours(1), 0.0);
  world.plan("first");
  const Json json = told(gains);
  EXPECT_FALSE(json.contains("landscape"));
  EXPECT_TRUE(json["blocks"].contains("voxel-gains"));
  world.plan("second");
  EXPECT_EQ(told(gains)["plan"], 1);
}

class EventStreamTest : public LivePageTest {
 protected:
  /// What a turn sends; empty for nothing.
  std::string turn(bool has_taken_all = true) { return turn_of(stream, has_taken_all); }

  std::string turn_of(EventStream& stream, bool has_taken_all) {
    std::string sent;
    is_going_on = stream.turn(has_taken_all, [&](const std::string& event) {
      sent = event;
      return true;
    });
    return sent;
  }

  WebLog log;
  EventStream stream{page, log, std::chrono::hours(1)};
  bool is_going_on = true;
};

TEST_F(EventStreamTest, TellsWhatIsNewOnce) {
  EXPECT_EQ(turn(), "retry: 1000\nevent: state\ndata: " + page.state() + "\n\n");
  EXPECT_EQ(turn(), "");
  world.scan();
  EXPECT_EQ(turn(), "event: state\ndata: " + page.state() + "\n\n");
  EXPECT_EQ(turn(), "");
  EXPECT_EQ(log.events, 2U);
}

TEST_F(EventStreamTest, TellsTheNewestOfAMillion) {
  turn();
  const auto plan = std::make_shared<const PlanResult>(
      world.store.published()->plan(test::small_request(), *make_solver("random", {})));
  for (int i = 0; i < 1'000'000; ++i) world.plans.record(plan, GainKind::positive);
  EXPECT_EQ(plan.use_count(), 2);  // here and as the newest
  EXPECT_THAT(turn(), HasSubstr("\"plan\":1000000,"));
  EXPECT_EQ(turn(), "");
  EXPECT_EQ(log.events, 2U);
}

TEST_F(EventStreamTest, QueuesNothingForWhoDoesNotReadAndLetsItGo) {
  turn();
  world.scan();
  EXPECT_EQ(turn(false), "");
  EXPECT_TRUE(is_going_on);
  world.plan("newest");
  EXPECT_THAT(turn(), HasSubstr("newest"));
  EventStream impatient(page, log, std::chrono::milliseconds(0));
  EXPECT_EQ(turn_of(impatient, false), "");
  EXPECT_FALSE(is_going_on);
  EXPECT_EQ(log.waits, 2U);
}

}  // namespace
}  // namespace nbvopt
