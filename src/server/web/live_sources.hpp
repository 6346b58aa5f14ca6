// Where the page of a server looks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/json.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "server/plan_log.hpp"

namespace nbvopt {

/// Called by any thread.
struct LiveSources {
  std::string title;
  std::uint64_t run_id = 0;  ///< of GetStatus
  std::function<std::shared_ptr<const ViewPlanner>()> published;
  std::function<PlanLog::Newest()> newest_plan;
};

/// On one line, whatever names and messages hold.
inline std::string line_of(const Json& json) {
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace nbvopt
