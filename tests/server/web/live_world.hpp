// What a page of the server's tests shows: the small map, and plans that are added to it.
#pragma once

#include <memory>
#include <mutex>

#include "nbvopt/solver/registry.hpp"
#include "server/map_store.hpp"
#include "server/server_world.hpp"
#include "server/web/live_page.hpp"

namespace nbvopt::test {

class LiveWorld {
 public:
  LiveSources sources() {
    return {.title = "small",
            .run_id = 7,
            .published = [this] { return store.published(); },
            .newest_plan = [this] { return plans.newest(); }};
  }

  void plan(const std::string& message, const GainChoice& gain = GainKind::positive) {
    auto plan = std::make_shared<PlanResult>(
        store.published()->plan(small_request(), *make_solver("random", {})));
    plan->message = message;
    plans.record(plan, gain);
  }

  void scan() { store.insert(small_scan(), scan_pose(1)); }

  MapStore store{small_robot(), {}, small_map(), 1};
  PlanLog plans;
};

}  // namespace nbvopt::test
