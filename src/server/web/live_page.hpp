// The page of a server's map: what it shows, as it changes.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "nbvopt/planner/view_planner.hpp"
#include "server/plan_log.hpp"

namespace nbvopt {

/// Where the page looks. Called by any thread.
struct LiveSources {
  std::string title;
  std::uint64_t run_id = 0;  ///< of GetStatus
  std::function<std::shared_ptr<const ViewPlanner>()> published;
  std::function<PlanLog::Newest()> newest_plan;
};

/// What there is to show: equal where nothing is new.
struct LiveVersion {
  std::uint64_t map = 0;
  std::uint64_t plan = 0;
  bool operator==(const LiveVersion&) const = default;
};

/// Safe to share between threads.
class LivePage {
 public:
  /// Maps are made at least `least_pause` apart.
  explicit LivePage(LiveSources sources,
                    std::chrono::milliseconds least_pause = std::chrono::milliseconds(500));

  /// The page itself, which asks for the rest.
  const std::shared_ptr<const std::string>& html() const { return html_; }

  LiveVersion newest() const;

  /// One line of JSON: `map`, which names the newest version; `map_version`; `plan`, its number;
  /// `answer`, the newest plan, where there is one.
  std::string state() const;

  /// The map's surface as MapPage::json() has it, with `id`: the `map` that it shows. Made when
  /// somebody asks and shared by all who do; when that takes long an older one is given, so that no
  /// more than a fifth of a core goes into it. Where the map is too large, `error` says so instead.
  std::shared_ptr<const std::string> map();

 private:
  using Clock = std::chrono::steady_clock;

  std::string id_of(std::uint64_t map_version) const;
  std::string made_map(const VoxelGrid& grid) const;

  const LiveSources sources_;
  const std::chrono::milliseconds least_pause_;
  std::shared_ptr<const std::string> html_;

  std::mutex making_;  ///< of what follows; held while a map is made
  std::shared_ptr<const std::string> map_;
  std::uint64_t made_version_ = 0;
  Clock::time_point next_ = Clock::time_point::min();
};

}  // namespace nbvopt
