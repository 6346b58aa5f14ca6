// nbvopt: the command line tool. Each subcommand has a file pair; this one reads the command line
// and turns what goes wrong into one line and an exit code.
#include <CLI/CLI.hpp>
#include <array>

#include "cli/calibrate.hpp"
#include "cli/evaluate.hpp"
#include "cli/map.hpp"
#include "cli/query.hpp"
#include "cli/reproduce.hpp"
#include "cli/robot.hpp"
#include "cli/serve.hpp"
#include "cli/simulate.hpp"
#include "cli/study.hpp"
#include "cli/terminal/exit_code.hpp"
#include "cli/terminal/output.hpp"
#include "cli/world.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::array kSubcommands{set_up_calibrate, set_up_query, set_up_evaluate, set_up_map,
                                  set_up_reproduce, set_up_robot, set_up_serve,    set_up_simulate,
                                  set_up_study,     set_up_world};

/// Parses and runs. What CLI11 throws to show help or the version is an answer, too.
void run(int argc, char** argv) {
  CLI::App app("Where should a camera on a pan / tilt / telescopic mast look next?", "nbvopt");
  app.set_version_flag("--version", tool_versions(), "print the versions of all that it stands on");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 answered, 2 wrong command line, 3 unusable file or value, 4 internal error.\n"
      "Errors are one line on standard error; standard output holds answers only.\n"
      "nbvopt SUBCOMMAND --help says more.");
  for (const auto set_up : kSubcommands) set_up(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
  }
}

int fail(ExitCode code, const std::string& message) {
  print_message(message);
  return static_cast<int>(code);
}

}  // namespace
}  // namespace nbvopt

int main(int argc, char** argv) {
  using namespace nbvopt;
  try {
    run(argc, argv);
    return static_cast<int>(ExitCode::answered);
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::usage_error, std::string(error.what()) + " (nbvopt --help tells more)");
  } catch (const UsageError& error) {
    return fail(ExitCode::usage_error, error.what());
  } catch (const ServerError& error) {
    return fail(error.kind() == ServerErrorKind::internal ? ExitCode::internal_error
                                                          : ExitCode::input_error,
                error.what());
  } catch (const Error& error) {
    return fail(ExitCode::input_error, error.what());
  } catch (const std::exception& error) {
    return fail(ExitCode::internal_error, std::string("internal error: ") + error.what());
  }
}
