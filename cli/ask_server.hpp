// What planning servers are asked.
#pragma once

#include "cli/options/query_arguments.hpp"
#include "cli/options/server_arguments.hpp"
#include "cli/query_answer.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// Its answer to a query. Throws ServerError for a call that fails, and UsageError where this
/// program was built without the server's libraries.
QueryAnswer ask_server(const QueryOptions& options, const PlanRequest& request);

/// What its scans have taught it, prior included. Throws the same, and UsageError where its robot's
/// gain is not expected.
HazardTable ask_server_for_hazards(const ServerArguments& server);

}  // namespace nbvopt
