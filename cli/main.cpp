// nbvopt: the command line tool. This file reads the command line and turns what goes wrong into
// one line and an exit code.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/app.hpp"
#include "cli/terminal/exit_code.hpp"
#include "cli/terminal/output.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// Parses and runs. What CLI11 throws to show help or the version is an answer, too.
void run(int argc, char** argv) {
  const std::unique_ptr<CLI::App> app = make_app();
  try {
    app->parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app->exit(help_or_version);
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
