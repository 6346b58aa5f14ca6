// The tool itself: help, version, exit codes, where output goes.
#include "cli/command_line.hpp"
#include "nbvopt/core/version.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Main, VersionTellsAllThatItStandsOn) {
  const ProcessResult result = nbvopt_run({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(StartsWith(version_report()), HasSubstr("gRPC 1.")));
  EXPECT_EQ(result.err, "");
}

TEST(Main, HelpTellsExitCodesAndSubcommands) {
  const ProcessResult result = nbvopt_run({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("0 answered, 2 wrong command line"), HasSubstr("query"),
                                HasSubstr("evaluate"), HasSubstr("map")));
}

TEST(Main, EverySubcommandExplainsItself) {
  for (const char* subcommand : {"query", "evaluate", "map", "serve"}) {
    const ProcessResult result = nbvopt_run({subcommand, "--help"});
    EXPECT_EQ(result.exit_code, 0) << subcommand;
    EXPECT_THAT(result.out, HasSubstr(std::string("Usage: nbvopt ") + subcommand));
  }
}

TEST(Main, WrongCommandLinesAreUsageErrors) {
  expect_refusal(nbvopt_run({}), 2, "subcommand");
  expect_refusal(nbvopt_run({"fly"}), 2, "subcommand");
  expect_refusal(nbvopt_run({"--fly"}), 2, "subcommand");
  expect_refusal(nbvopt_run({"query"}), 2, "--base");
  expect_refusal(nbvopt_run({"evaluate", "m.ot"}), 2, "--poses");
  expect_refusal(nbvopt_run({"evaluate", "m.ot", "--poses", "-", "--fly\nhigh"}), 2, "--fly");
}

TEST_F(CommandLine, FullStandardOutputIsAnError) {
  const ProcessResult result = run_process(
      "/bin/sh", {"-c", cli_program() + " evaluate '" + map_file + "' --poses - > /dev/full"},
      R"({"cases": []})");
  expect_refusal(result, 3, "standard output");
}

}  // namespace
}  // namespace nbvopt::test
