#include "web/answer_file.hpp"

#include <gmock/gmock.h>

#include "core/json.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"

namespace nbvopt::test {
namespace {

using ::testing::HasSubstr;

Json answer() {
  return {{"pan", 0.5},
          {"tilt", -0.25},
          {"height", 0.4},
          {"gain", 20.0},
          {"current_gain", 10.0},
          {"status", "time_limit"},
          {"message", "move"},
          {"request",
           {{"base", {{"x", 1.0}, {"y", 2.0}, {"z", 3.0}, {"yaw", 0.0}}},
            {"pan", 0.1},
            {"tilt", 0.2},
            {"height", 0.3},
            {"motion_time", 0.5},
            {"base_velocity", {{"vx", 0.25}, {"vy", 0.0}, {"wz", -0.5}}}}}};
}

std::string refusal_of(const std::string& text) {
  return message_of<InputError>([&] { parse_answer_file(text, "a.json"); });
}

TEST(AnswerFile, HoldsQuestionAndAnswer) {
  const AnswerFile file = parse_answer_file(answer().dump(), "a.json");
  EXPECT_EQ(file.joints, (JointPosition{0.5, -0.25, 0.4}));
  EXPECT_EQ(file.gain, 20.0);
  EXPECT_EQ(file.current_gain, 10.0);
  EXPECT_EQ(file.why, "time_limit: move");
  EXPECT_EQ(file.request.joints, (JointPosition{0.1, 0.2, 0.3}));
  EXPECT_EQ(file.request.motion_time_s, 0.5);
  EXPECT_EQ(file.request.T_map_base.translation(), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(file.request.base_twist, (BaseTwist{0.25, 0.0, -0.5}));
}

TEST(AnswerFile, NamesWhatIsWrong) {
  EXPECT_THAT(refusal_of("{"), HasSubstr("a.json: line 1: not valid JSON"));
  EXPECT_THAT(refusal_of("[]"), HasSubstr("a.json must be an object"));
  EXPECT_THAT(refusal_of("{}"), HasSubstr("give what nbvopt query --json wrote"));
  Json wrong = answer();
  wrong["request"]["base"]["yaw"] = "north";
  EXPECT_THAT(refusal_of(wrong.dump()), HasSubstr("a.json.request.base: 'yaw' must be a number"));
  wrong = answer();
  wrong["gain"] = nullptr;
  EXPECT_THAT(refusal_of(wrong.dump()), HasSubstr("'gain' must be a number"));
  wrong = answer();
  wrong["message"] = 5;
  EXPECT_THAT(refusal_of(wrong.dump()), HasSubstr("'message' must be a text"));
}

}  // namespace
}  // namespace nbvopt::test
