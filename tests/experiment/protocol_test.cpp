#include "experiment/protocol.hpp"

#include <gmock/gmock.h>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"

namespace nbvopt::experiment {
namespace {

using testing::HasSubstr;

TEST(Protocol, KeepsAUnit) {
  const Unit unit{"id", {{"map", "room.ot"}, {"times", {0.1, 1.0 / 3.0}}}};
  EXPECT_EQ(unit_line(unit), R"({"unit":"id","map":"room.ot","times":[0.1,0.3333333333333333]})");
  const Unit read = parse_unit(unit_line(unit));
  EXPECT_EQ(read.id, unit.id);
  EXPECT_EQ(read.payload, unit.payload);
}

TEST(Protocol, RefusesWhatIsNoUnit) {
  for (const char* line : {"", "3", "[]", "{}", R"({"unit":3})", R"({"unit":"id")"}) {
    EXPECT_THAT(test::message_of<InputError>([&] { parse_unit(line); }), HasSubstr("unit: "))
        << line;
  }
}

TEST(Protocol, KeepsAnswersAndFailures) {
  const Outcome answered{.answer = {{"gain", 0.1}}, .busy_ms = 2.5};
  const auto answer = parse_answer(answer_line("id", answered));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->id, "id");
  EXPECT_EQ(answer->outcome.answer, answered.answer);
  EXPECT_EQ(answer->outcome.failure, "");
  EXPECT_EQ(answer->outcome.busy_ms, 2.5);

  const auto failure = parse_answer(answer_line("id", {.answer = Json(), .failure = "why"}));
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->outcome.answer.is_null());
  EXPECT_EQ(failure->outcome.failure, "why");
}

TEST(Protocol, TakesNothingElseForAnAnswer) {
  for (const char* line :
       {"", "3", "[]", "{}", R"({"unit":"id","answer":{}})", R"({"answer":{},"busy_ms":1})",
        R"({"unit":"id","busy_ms":1})", R"({"unit":"id","answer":3,"busy_ms":1})",
        R"({"unit":"id","failure":"","busy_ms":1})",
        R"({"unit":"id","answer":{},"failure":"why","busy_ms":1})"}) {
    EXPECT_FALSE(parse_answer(line)) << line;
  }
}

TEST(Protocol, KnowsAHello) {
  EXPECT_TRUE(is_hello(hello_line()));
  EXPECT_TRUE(is_hello(R"({"protocol":1})"));
  for (const char* line : {"", "hello", "1", "{}", R"({"protocol":2})"}) {
    EXPECT_FALSE(is_hello(line)) << line;
  }
}

}  // namespace
}  // namespace nbvopt::experiment
