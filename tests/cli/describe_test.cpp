// Man pages and completions of a small command line, and those of the tool as shells load them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/app.hpp"
#include "cli/describe/completion.hpp"
#include "cli/describe/man_page.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using test::ProcessResult;
using test::run_process;
using test::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A tool with a command that has a bit of everything.
struct Tool {
  CLI::App app{"A tool", "tool"};
  CLI::App* look = nullptr;
  std::string text;
  bool flag = false;

  Tool() {
    look = app.add_subcommand("look", "What it's like: [all]");
    look->add_option("MAP", text, "a map")->required();
    look->add_option("-o,--out", text, "what it writes")->type_name("FILE");
    look->option_defaults()->group("How");
    look->add_option("--solver", text, "the search")
        ->check(CLI::IsMember({"grid", "nlopt:lbfgs", "nlopt:mma"}))
        ->type_name("NAME")
        ->default_str("grid");
    look->add_flag("--fast", flag, "don't wait\nfor it");
    look->footer(".Example: a\\b");
    app.add_subcommand("list", "List things")->add_subcommand("names", "By name");
    app.add_subcommand("worker", "Not for people")->group("");
  }
};

TEST(ManPage, TellsArgumentsOptionsAndFooterByGroups) {
  const Tool tool;
  const std::string page = man_page({tool.look, "tool look"}, "1.2.3");
  EXPECT_THAT(page,
              AllOf(testing::StartsWith(".TH \"TOOL\\-LOOK\" \"1\" \"\" \"nbvopt 1.2.3\""),
                    HasSubstr("tool\\-look \\- What it's like: [all]\n"),
                    HasSubstr("\\fBtool look\\fR [\\fIOPTIONS\\fR] \\fIMAP\\fR\n"),
                    HasSubstr(".SH \"ARGUMENTS\"\n.TP\n\\fIMAP\\fR\na map. Required.\n"),
                    HasSubstr("\\fB\\-o\\fR, \\fB\\-\\-out\\fR \\fIFILE\\fR\nwhat it writes.")));
  EXPECT_THAT(page,
              AllOf(HasSubstr(".SH \"HOW\"\n.TP\n\\fB\\-\\-solver\\fR \\fINAME\\fR\nthe search. "
                              "One of grid, nlopt:lbfgs, nlopt:mma. Default: grid.\n"),
                    HasSubstr("\\fB\\-\\-fast\\fR\ndon't wait\nfor it.\n"),
                    HasSubstr(".nf\n\\&.Example: a\\eb\n.fi"), HasSubstr("\\fBtool\\fR(1)")));
  EXPECT_THAT(man_page({&tool.app, "tool"}, "1"),
              HasSubstr("\\fBtool\\-look\\fR(1)\nWhat it's like: [all]\n"));
}

TEST(ManPage, IsWellFormedForEveryCommand) {
  if (run_process("/usr/bin/which", {"man"}).exit_code != 0) GTEST_SKIP() << "there is no man";
  const TemporaryFolder folder;
  const auto app = make_app();
  std::vector<std::string> arguments{"--warnings", "-l"};
  for (const Command& command : all_commands(*app)) {
    arguments.push_back(folder.write(page_name(command) + ".1", man_page(command, "1.0")));
  }
  const ProcessResult shown = run_process("/usr/bin/man", arguments);
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(shown.err, "");
  for (const char* part : {"NBVOPT(1)", "NBVOPT-MAP-BUILD(1)", "SYNOPSIS", "OPTIONS"}) {
    EXPECT_THAT(shown.out, HasSubstr(part));
  }
}

/// What bash offers at the end of a line, a word a line, sorted; "(files)" where it is files.
std::string completed(const std::string& script, const std::string& line) {
  const std::string program = script + R"sh(
compopt() { echo "(files)"; }
COMP_LINE=$1 COMP_POINT=${#1}
_tool
((${#COMPREPLY[@]})) && printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort
true
)sh";
  const ProcessResult result = run_process("/bin/bash", {"-c", program, "bash", line});
  EXPECT_EQ(result.err, "");
  return result.out;
}

TEST(BashCompletion, OffersWhatFits) {
  const Tool tool;
  const std::string script = bash_completion(tool.app);
  const auto offers = [&](const std::string& line) { return completed(script, line); };
  EXPECT_EQ(offers("tool "), "list\nlook\n");
  EXPECT_EQ(offers("tool li"), "list\n");
  EXPECT_EQ(offers("tool list "), "names\n");
  EXPECT_EQ(offers("tool look --s"), "--solver\n");
  EXPECT_EQ(offers("tool look -"), "--fast\n--help\n--out\n--solver\n-h\n-o\n");
  EXPECT_EQ(offers("tool look --solver "), "grid\nnlopt:lbfgs\nnlopt:mma\n");
  EXPECT_EQ(offers("tool look --solver=g"), "grid\n");
  EXPECT_EQ(offers("tool look --solver nlopt:l"), "lbfgs\n") << "bash breaks words at colons";
  EXPECT_EQ(offers("tool look --solver zzz"), "");
  EXPECT_EQ(offers("tool look -o "), "(files)\n");
  EXPECT_EQ(offers("tool look "), "(files)\n");
}

TEST(Completion, ScriptsOfTheToolAreSound) {
  const TemporaryFolder folder;
  const auto app = make_app();
  const std::string bash = folder.write("nbvopt", bash_completion(*app));
  EXPECT_EQ(run_process("/bin/bash", {"-n", bash}).err, "");
  EXPECT_THAT(bash_completion(*app), AllOf(HasSubstr("'nbvopt map build --format'"),
                                           Not(HasSubstr("PROGRAM")), Not(HasSubstr("OPTIONS"))));
  const std::string zsh = folder.write("_nbvopt", zsh_completion(*app));
  if (run_process("/usr/bin/which", {"zsh"}).exit_code != 0) GTEST_SKIP() << "there is no zsh";
  EXPECT_EQ(run_process("/usr/bin/zsh", {"-n", zsh}).err, "");
}

}  // namespace
}  // namespace nbvopt
