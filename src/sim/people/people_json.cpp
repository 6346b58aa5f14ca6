#include "sim/people/people_json.hpp"

#include <string>
#include <variant>
#include <vector>

namespace nbvopt {
namespace {

Json numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Vector3d vector_in(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json walk_json(const std::monostate&) { return nullptr; }

Json walk_json(const ScriptedWalk& walk) {
  Json waypoints = Json::array();
  for (const Waypoint& waypoint : walk.waypoints) {
    waypoints.push_back({{"time_s", waypoint.time_s},
                         {"position_map_m", numbers(waypoint.position_map_m)},
                         {"yaw_rad", waypoint.yaw_rad}});
  }
  return {{"waypoints", waypoints},
          {"is_loop", walk.is_loop},
          {"delay_s", walk.delay_s},
          {"starts_itself", walk.starts_itself}};
}

Json walk_json(const TargetWalk& walk) {
  return {{"target_map_m", numbers(walk.target_map_m)},
          {"target_weight", walk.target_weight},
          {"obstacle_weight", walk.obstacle_weight},
          {"ignored_models", walk.ignored_models}};
}

decltype(Person::walk) walk_in(const Json& json) {
  if (json.is_null()) return std::monostate();
  if (json.contains("target_map_m")) {
    return TargetWalk{.target_map_m = vector_in(json.at("target_map_m")),
                      .target_weight = json.at("target_weight").get<double>(),
                      .obstacle_weight = json.at("obstacle_weight").get<double>(),
                      .ignored_models = json.at("ignored_models").get<std::vector<std::string>>()};
  }
  ScriptedWalk walk{.waypoints = {},
                    .is_loop = json.at("is_loop").get<bool>(),
                    .delay_s = json.at("delay_s").get<double>(),
                    .starts_itself = json.at("starts_itself").get<bool>()};
  for (const Json& waypoint : json.at("waypoints")) {
    walk.waypoints.push_back({.time_s = waypoint.at("time_s").get<double>(),
                              .position_map_m = vector_in(waypoint.at("position_map_m")),
                              .yaw_rad = waypoint.at("yaw_rad").get<double>()});
  }
  return walk;
}

}  // namespace

Json to_json(const People& people) {
  Json persons = Json::array();
  for (const Person& person : people.persons) {
    persons.push_back(
        {{"name", person.name},
         {"position_map_m", numbers(person.position_map_m)},
         {"yaw_rad", person.yaw_rad},
         {"walk", std::visit([](const auto& walk) { return walk_json(walk); }, person.walk)}});
  }
  Json models = Json::array();
  for (const ModelPlace& model : people.models) {
    models.push_back({{"name", model.name}, {"position_map_m", numbers(model.position_map_m)}});
  }
  return {{"persons", persons}, {"models", models}};
}

People people_of(const Json& json) {
  People people;
  for (const Json& person : json.at("persons")) {
    people.persons.push_back({.name = person.at("name").get<std::string>(),
                              .position_map_m = vector_in(person.at("position_map_m")),
                              .yaw_rad = person.at("yaw_rad").get<double>(),
                              .walk = walk_in(person.at("walk"))});
  }
  for (const Json& model : json.at("models")) {
    people.models.push_back({.name = model.at("name").get<std::string>(),
                             .position_map_m = vector_in(model.at("position_map_m"))});
  }
  return people;
}

}  // namespace nbvopt
