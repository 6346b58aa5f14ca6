// The answer of a query, for machines and for people.
#pragma once

#include <optional>
#include <string>

#include "core/json.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// Where an answer came from that another process computed.
struct RemoteCall {
  std::string server;    ///< its address
  double call_ms = 0.0;  ///< from the question to the answer
};

/// What the planner said, and what it cost to get there.
struct QueryAnswer {
  PlanResult result;
  std::string evaluator = "exact";
  Counting counting = Counting::per_ray;
  std::optional<RemoteCall> remote;  ///< none: searched here, on a map that was read
  double map_load_ms = 0.0;
};

/// One object with the keys that docs/guide/query.md explains.
Json to_json(const QueryAnswer& answer);

/// A few lines: where to look, what it gains, why, how long the move and the search take.
std::string to_text(const QueryAnswer& answer);

}  // namespace nbvopt
