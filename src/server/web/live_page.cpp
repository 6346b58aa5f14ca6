#include "server/web/live_page.hpp"

#include <algorithm>
#include <utility>

#include "core/json.hpp"
#include "nbvopt/core/error.hpp"
#include "web/answer_json.hpp"
#include "web/map_page.hpp"
#include "web/page.hpp"

namespace nbvopt {
namespace {

/// On one line, whatever names and messages hold.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace

LivePage::LivePage(LiveSources sources, std::chrono::milliseconds least_pause)
    : sources_(std::move(sources)), least_pause_(least_pause) {
  const std::shared_ptr<const ViewPlanner> planner = sources_.published();
  const Robot& robot = planner->robot();
  const Json data{
      {"live", true}, {"camera", camera_json(robot.sensor)}, {"mast", mast_json(robot.mast)}};
  html_ = std::make_shared<const std::string>(page_html(sources_.title, data, {}, PageKind::live));
}

LiveVersion LivePage::newest() const {
  return {sources_.published()->map_version(), sources_.newest_plan().number};
}

std::string LivePage::id_of(std::uint64_t map_version) const {
  return std::to_string(sources_.run_id) + "-" + std::to_string(map_version);
}

std::string LivePage::state() const {
  const std::shared_ptr<const ViewPlanner> planner = sources_.published();
  const PlanLog::Newest newest = sources_.newest_plan();
  Json state{{"map", id_of(planner->map_version())},
             {"map_version", planner->map_version()},
             {"plan", newest.number}};
  if (newest.plan) state["answer"] = answer_json(answer_of(*newest.plan), planner->mast());
  return line_of(state);
}

std::shared_ptr<const std::string> LivePage::map() {
  constexpr int kShare = 4;  // of the time that it took
  const std::scoped_lock lock(making_);
  const std::shared_ptr<const VoxelGrid> grid = sources_.published()->grid();
  const Clock::time_point start = Clock::now();
  if (map_ != nullptr && (made_version_ == grid->version() || start < next_)) return map_;
  map_ = std::make_shared<const std::string>(made_map(*grid));
  made_version_ = grid->version();
  const Clock::time_point end = Clock::now();
  next_ = end + std::max<Clock::duration>(least_pause_, kShare * (end - start));
  return map_;
}

std::string LivePage::made_map(const VoxelGrid& grid) const {
  const std::string id = id_of(grid.version());
  try {
    Json json = MapPage(sources_.title, grid).json();
    json["id"] = id;
    return line_of(json);
  } catch (const InputError& error) {
    return line_of({{"id", id}, {"error", error.what()}});
  }
}

}  // namespace nbvopt
