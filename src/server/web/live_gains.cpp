#include "server/web/live_gains.hpp"

#include <utility>

#include "nbvopt/core/error.hpp"
#include "server/planner_by_gain.hpp"
#include "web/answer_json.hpp"
#include "web/page.hpp"
#include "web/view_gains.hpp"

namespace nbvopt {
LiveGains::LiveGains(LiveSources sources, std::chrono::milliseconds least_pause, double most_ms)
    : sources_(std::move(sources)), most_ms_(most_ms), pace_(least_pause) {}

std::shared_ptr<const std::string> LiveGains::newest() {
  const std::scoped_lock lock(making_);
  const PlanLog::Newest newest = sources_.newest_plan();
  const auto start = MakingPace::Clock::now();
  if (text_ != nullptr && (plan_ == newest.number || !pace_.allows(start))) return text_;
  text_ = std::make_shared<const std::string>(made(newest));
  plan_ = newest.number;
  pace_.took(start, MakingPace::Clock::now());
  return text_;
}

std::string LiveGains::made(const PlanLog::Newest& newest) const {
  Json json{{"plan", newest.number}};
  if (!newest.plan) return line_of(json);
  try {
    const auto planner = planner_by_gain(sources_.published(), newest.gain);
    const AnswerFile answer = answer_of(*newest.plan);
    json["answer"] = answer_json(answer, planner->mast());
    json["map_version"] = planner->map_version();
    StopRule stop = StopRule::within(most_ms_);
    stop.cancel = end_;
    const ViewGains gains = view_gains(answer, *planner, 1, stop);
    json.update(gains.data);
    Json& blocks = json["blocks"] = Json::object();
    for (const PageBlock& block : gains.blocks) blocks[block.id] = block.base64;
  } catch (const InputError& error) {  // the plan was to another map, say
    json["error"] = error.what();
  }
  return line_of(json);
}

}  // namespace nbvopt
