#include "cli/ask_server.hpp"

#include <utility>

#include "core/stopwatch.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

QueryAnswer ask_server(const QueryOptions& options, const PlanRequest& request) {
  PlannerClient client(options.server.address, options.server.tls);
  QueryAnswer answer;
  const Stopwatch calling;
  RemotePlan plan = client.plan(request, search_of(options.solver), gain_of(options.view));
  answer.remote = {.server = options.server.address, .call_ms = calling.elapsed_ms()};
  answer.counting = plan.counting;
  answer.result = std::move(plan.result);
  return answer;
}

HazardTable ask_server_for_hazards(const ServerArguments& server) {
  const ServerStatus status = PlannerClient(server.address, server.tls).status();
  if (status.hazards) return *status.hazards;
  throw UsageError("the server at " + server.address +
                   " learns no hazards: its gain is not expected, see --gain of nbvopt serve");
}

}  // namespace nbvopt
