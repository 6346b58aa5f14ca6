#include "sim/world/sdf_actor.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

double yaw_of(const Eigen::Affine3d& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}

[[noreturn]] void refuse_part(const SdfElement& element, const std::string& what) {
  throw InputError("line " + std::to_string(element.GetLineNum()) + ": <" + element.Name() + "> " +
                   what);
}

bool flag_of(const SdfElement& parent, const char* child, bool otherwise) {
  const SdfElement* element = parent.FirstChildElement(child);
  if (element == nullptr) return otherwise;
  const std::string text = text_of(element);
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  refuse_value(*element, "true or false");
}

/// A time, which is not negative.
double time_of(const SdfElement& parent, const char* child) {
  const double time_s = number_of(parent, child, 0.0);
  if (time_s < 0.0) {
    refuse_value(*parent.FirstChildElement(child), "0 or more");
  }
  return time_s;
}

/// The waypoints of one <trajectory> in the order of their times. As in Gazebo, the first one is
/// passed at 0 whatever it says, and of two at one time the last counts.
std::vector<Waypoint> trajectory_of(const SdfElement& trajectory) {
  std::map<double, Waypoint> by_time;
  for (const SdfElement* element = trajectory.FirstChildElement("waypoint"); element != nullptr;
       element = element->NextSiblingElement("waypoint")) {
    const SdfElement* pose = element->FirstChildElement("pose");
    if (element->FirstChildElement("time") == nullptr || pose == nullptr) {
      refuse_part(*element, "must have a <time> and a <pose>");
    }
    const double time_s = time_of(*element, "time");
    const Eigen::Affine3d T_map_waypoint = pose_of(*pose);
    by_time[time_s] = {time_s, T_map_waypoint.translation(), yaw_of(T_map_waypoint)};
  }
  if (by_time.empty()) refuse_part(trajectory, "has no <waypoint>");
  std::vector<Waypoint> waypoints;
  for (const auto& [time_s, waypoint] : by_time) waypoints.push_back(waypoint);
  waypoints.front().time_s = 0.0;
  return waypoints;
}

/// The trajectories one after the other, in the order of their numbers; none where there is none.
std::optional<ScriptedWalk> script_of(const SdfElement& actor) {
  const SdfElement* script = actor.FirstChildElement("script");
  if (script == nullptr) return std::nullopt;
  std::multimap<double, const SdfElement*> trajectories;
  for (const SdfElement* element = script->FirstChildElement("trajectory"); element != nullptr;
       element = element->NextSiblingElement("trajectory")) {
    trajectories.emplace(element->DoubleAttribute("id"), element);
  }
  if (trajectories.empty()) return std::nullopt;
  ScriptedWalk walk{.waypoints = {},
                    .is_loop = flag_of(*script, "loop", true),
                    .delay_s = time_of(*script, "delay_start"),
                    .starts_itself = flag_of(*script, "auto_start", true)};
  for (const auto& [id, element] : trajectories) {
    const double begin_s = walk.waypoints.empty() ? 0.0 : walk.waypoints.back().time_s;
    // Where one ends, the next begins: the later of the two counts there.
    for (Waypoint waypoint : trajectory_of(*element)) {
      waypoint.time_s += begin_s;
      if (!walk.waypoints.empty() && walk.waypoints.back().time_s == waypoint.time_s) {
        walk.waypoints.pop_back();
      }
      walk.waypoints.push_back(waypoint);
    }
  }
  return walk;
}

TargetWalk target_walk_of(const SdfElement& plugin) {
  TargetWalk walk;
  walk.target_map_m = vector_of(plugin, "target", walk.target_map_m);
  walk.target_weight = number_of(plugin, "target_weight", walk.target_weight);
  walk.obstacle_weight = number_of(plugin, "obstacle_weight", walk.obstacle_weight);
  const SdfElement* ignored = plugin.FirstChildElement("ignore_obstacles");
  if (ignored == nullptr) return walk;
  for (const SdfElement* model = ignored->FirstChildElement("model"); model != nullptr;
       model = model->NextSiblingElement("model")) {
    walk.ignored_models.push_back(text_of(model));
  }
  return walk;
}

/// Of the actor's plugin; none where it has none.
std::optional<TargetWalk> target_walk_in(const SdfElement& actor) {
  const SdfElement* unknown = nullptr;
  for (const SdfElement* plugin = actor.FirstChildElement("plugin"); plugin != nullptr;
       plugin = plugin->NextSiblingElement("plugin")) {
    const std::string file =
        std::filesystem::path(attribute_of(*plugin, "filename")).stem().string();
    if (file == "libActorPlugin" || file == "ActorPlugin") return target_walk_of(*plugin);
    unknown = plugin;
  }
  if (unknown == nullptr) return std::nullopt;
  refuse_part(*unknown, "'" + attribute_of(*unknown, "filename") +
                            "' is not known: give libActorPlugin.so, or a <script> with a "
                            "<trajectory>");
}

}  // namespace

Person actor_of(const SdfElement& actor, SdfFrames& frames) {
  const Eigen::Affine3d T_map_actor = frames.T_scope(actor.FirstChildElement("pose"));
  Person person{.name = attribute_of(actor, "name"),
                .position_map_m = T_map_actor.translation(),
                .yaw_rad = yaw_of(T_map_actor)};
  if (auto script = script_of(actor)) {
    person.walk = *std::move(script);
  } else if (auto target_walk = target_walk_in(actor)) {
    person.walk = *std::move(target_walk);
  }
  return person;
}

}  // namespace nbvopt
