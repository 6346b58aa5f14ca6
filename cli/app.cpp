#include "cli/app.hpp"

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
#include "cli/view.hpp"
#include "cli/world.hpp"

namespace nbvopt {
namespace {

constexpr std::array kSubcommands{set_up_calibrate, set_up_query, set_up_evaluate, set_up_map,
                                  set_up_reproduce, set_up_robot, set_up_serve,    set_up_simulate,
                                  set_up_study,     set_up_view,  set_up_world};

}  // namespace

std::unique_ptr<CLI::App> make_app() {
  auto app = std::make_unique<CLI::App>(
      "Where should a camera on a pan / tilt / telescopic mast look next?", "nbvopt");
  app->set_version_flag("--version", tool_versions(),
                        "print the versions of all that it stands on");
  app->require_subcommand(1);
  app->footer(
      "Exit codes: 0 answered, 2 wrong command line, 3 unusable file or value, 4 internal error.\n"
      "Errors are one line on standard error; standard output holds answers only.\n"
      "nbvopt SUBCOMMAND --help says more.");
  for (const auto set_up : kSubcommands) set_up(*app);
  return app;
}

}  // namespace nbvopt
