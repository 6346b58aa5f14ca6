#include "server/web/live_page.hpp"

#include <charconv>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "web/answer_json.hpp"
#include "web/map_page.hpp"
#include "web/page.hpp"

namespace nbvopt {

LivePage::LivePage(LiveSources sources, std::chrono::milliseconds least_pause)
    : sources_(std::move(sources)), gains_(sources_, least_pause), pace_(least_pause) {
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

std::optional<std::uint64_t> LivePage::version_of(std::string_view id) const {
  const std::string run = std::to_string(sources_.run_id) + "-";
  if (!id.starts_with(run)) return std::nullopt;
  id.remove_prefix(run.size());
  std::uint64_t version = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), version);
  if (error != std::errc() || end != id.data() + id.size()) return std::nullopt;
  return version;
}

void LivePage::keep_up() {
  const std::shared_ptr<const VoxelGrid> grid = sources_.published()->grid();
  const auto start = MakingPace::Clock::now();
  if (surface_.version() == grid->version() || !pace_.allows(start)) return;
  surface_.show(grid);
  map_json_ =
      map_json(sources_.title, grid->lattice(), grid->carries_uncertainty(), surface_.counts());
  if (readers_ == 0) surface_.forget_grid();
  pace_.took(start, MakingPace::Clock::now());
}

SharedBytes LivePage::map(const std::string& since) {
  const std::scoped_lock lock(making_);
  keep_up();
  std::optional<std::uint64_t> version = version_of(since);
  if (version && !surface_.knows(*version)) version.reset();
  const std::string id = id_of(surface_.version());
  try {
    const SharedBytes bricks = surface_.members(version);
    std::string head = line_of(
        {{"id", id}, {"is_whole", !version}, {"map", map_json_}, {"bricks", Json::object()}});
    constexpr std::size_t kOpenEnds = 2;  // the braces of the bricks and of all
    SharedBytes answer(head.substr(0, head.size() - kOpenEnds));
    for (const SharedBytes::Piece& piece : bricks.pieces()) answer.append(piece);
    answer.append(std::string("}}"));
    return answer;
  } catch (const InputError& error) {
    return SharedBytes(line_of({{"id", id}, {"error", error.what()}}));
  }
}

void LivePage::end_reader() {
  if (--readers_ > 0) return;
  const std::scoped_lock lock(making_);
  if (readers_ == 0) surface_.forget_grid();
}

}  // namespace nbvopt
