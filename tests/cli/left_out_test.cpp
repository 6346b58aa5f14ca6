// Commands of parts that a build leaves out: still known, refused with a remedy.
#include <CLI/CLI.hpp>

#include "cli/ask_server.hpp"
#include "cli/reproduce.hpp"
#include "cli/serve.hpp"
#include "cli/study.hpp"
#include "nbvopt/core/version.hpp"
#include "support/error_message.hpp"

namespace nbvopt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal_of(void (*set_up)(CLI::App&), const std::string& command_line) {
  CLI::App app;
  set_up(app);
  return message_of<UsageError>([&] { app.parse(command_line); });
}

TEST(LeftOut, CommandsNameThePartWhateverTheyAreAsked) {
  EXPECT_THAT(refusal_of(set_up_serve, "serve map.ot --listen unix:/a"),
              AllOf(HasSubstr("nbvopt serve is not in this build"),
                    HasSubstr("NBVOPT_BUILD_SERVER"), HasSubstr("make build")));
  EXPECT_THAT(refusal_of(set_up_study, "study run spec.yaml --out out"),
              AllOf(HasSubstr("nbvopt study"), HasSubstr("NBVOPT_BUILD_STUDY")));
  EXPECT_THAT(refusal_of(set_up_reproduce, "reproduce"), HasSubstr("nbvopt reproduce"));
}

TEST(LeftOut, AQueryCannotAskAServer) {
  EXPECT_THAT(message_of<UsageError>([] { ask_server({}, {}); }),
              AllOf(HasSubstr("--server"), HasSubstr("NBVOPT_BUILD_SERVER")));
}

TEST(LeftOut, TheVersionsAreThoseOfTheLibrary) { EXPECT_EQ(tool_versions(), version_report()); }

}  // namespace
}  // namespace nbvopt::test
