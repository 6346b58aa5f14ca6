// Where the page of a server looks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

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

}  // namespace nbvopt
