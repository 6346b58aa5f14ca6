// Stands in for serve.cpp and ask_server.cpp in a program without gRPC.
#include "cli/ask_server.hpp"
#include "cli/left_out.hpp"
#include "cli/serve.hpp"
#include "nbvopt/core/version.hpp"

namespace nbvopt {

void set_up_serve(CLI::App& app) { add_left_out(app, "serve", "SERVER"); }

std::string tool_versions() { return version_report(); }

QueryAnswer ask_server(const QueryOptions& /*options*/, const PlanRequest& /*request*/) {
  refuse_left_out("--server", "SERVER");
}

HazardTable ask_server_for_hazards(const ServerArguments& /*server*/) {
  refuse_left_out("--server", "SERVER");
}

}  // namespace nbvopt
