// A query that a planning server answers.
#pragma once

#include "cli/options/query_arguments.hpp"
#include "cli/query_answer.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// Throws ServerError for a call that fails, and UsageError where this program was built without
/// the server's libraries.
QueryAnswer ask_server(const QueryOptions& options, const PlanRequest& request);

}  // namespace nbvopt
