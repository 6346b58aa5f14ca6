#include "web/episode_file.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "nbvopt/core/error.hpp"
#include "sim/episode_output.hpp"
#include "support/error_message.hpp"

namespace nbvopt::test {
namespace {

using ::testing::HasSubstr;

std::string line_of(const Capture& capture) { return to_json(capture).dump() + '\n'; }

TEST(EpisodeFile, HoldsWhatSimulateWrites) {
  Capture capture;
  capture.time_s = 1.5;
  capture.T_map_base = base_pose(1.0, 2.0, 0.5, 0.25);
  capture.joints = {0.5, -0.25, 0.4};
  capture.information = 20.0;
  Capture planned = capture;
  planned.predicted_gain = 3.0;
  planned.realised_gain = 4.0;
  const auto captures = parse_episode_file(line_of(capture) + line_of(planned), "m.jsonl");
  ASSERT_EQ(captures.size(), 2U);
  EXPECT_EQ(captures[0].time_s, 1.5);
  EXPECT_TRUE(captures[0].T_map_base.isApprox(capture.T_map_base));
  EXPECT_EQ(captures[0].joints, capture.joints);
  EXPECT_EQ(captures[0].information, 20.0);
  EXPECT_TRUE(std::isnan(captures[0].predicted_gain));
  EXPECT_EQ(captures[1].predicted_gain, 3.0);
  EXPECT_EQ(captures[1].realised_gain, 4.0);
}

TEST(EpisodeFile, NamesTheLineThatIsWrong) {
  const auto refusal_of = [](const std::string& text) {
    return message_of<InputError>([&] { parse_episode_file(text, "m.jsonl"); });
  };
  const std::string right = line_of(Capture{});
  EXPECT_THAT(refusal_of(right + "{"), HasSubstr("m.jsonl: line 2: not valid JSON"));
  EXPECT_THAT(refusal_of("{}"),
              HasSubstr("line 1: 'time_s' is missing, give what nbvopt simulate"));
  EXPECT_THAT(refusal_of("5"), HasSubstr("line 1 must be an object"));
  Json wrong = to_json(Capture{});
  wrong["base"] = {1, 2, 3};
  EXPECT_THAT(refusal_of(wrong.dump()), HasSubstr("'base' must be a list of 4 numbers"));
  wrong = to_json(Capture{});
  wrong["predicted_gain"] = "much";
  EXPECT_THAT(refusal_of(wrong.dump()), HasSubstr("'predicted_gain' must be a number"));
  const std::string many(kMostCaptures + 1, '\n');
  EXPECT_THAT(refusal_of(many), HasSubstr("more than 65535 captures"));
}

}  // namespace
}  // namespace nbvopt::test
