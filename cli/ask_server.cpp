#include "cli/ask_server.hpp"

#include <utility>

#include "core/stopwatch.hpp"
#include "nbvopt/client/planner_client.hpp"

namespace nbvopt {

QueryAnswer ask_server(const QueryOptions& options, const PlanRequest& request) {
  PlannerClient client(options.server, options.tls);
  QueryAnswer answer;
  const Stopwatch calling;
  RemotePlan plan = client.plan(request, search_of(options.solver));
  answer.remote = {.server = options.server, .call_ms = calling.elapsed_ms()};
  answer.counting = plan.counting;
  answer.result = std::move(plan.result);
  return answer;
}

}  // namespace nbvopt
