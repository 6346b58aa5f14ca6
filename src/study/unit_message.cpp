#include "study/unit_message.hpp"

#include <array>
#include <utility>

#include "fields/json.hpp"
#include "fields/store.hpp"
#include "nbvopt/core/error.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<study::WorkKind> = std::to_array<EnumName<study::WorkKind>>({
    {study::WorkKind::query, "query"},
    {study::WorkKind::reference, "reference"},
});

}  // namespace nbvopt

namespace nbvopt::study {
namespace {

/// Null stands for a limit that there is not.
Json limit_json(auto limit) { return limit > 0 ? Json(limit) : Json(nullptr); }

template <class Limit>
Limit limit_of(const Json& json) {
  return json.is_null() ? Limit{} : json.get<Limit>();
}

WorkUnit read_unit(const Json& json) {
  WorkUnit unit{.id = {},
                .kind = WorkKind::query,
                .map = json.at("map").get<std::string>(),
                .map_digest = json.at("map_digest").get<std::string>(),
                .robot = json.at("robot").get<std::string>(),
                .start = start_of(json.at("start")),
                .motion_time_s = json.at("motion_time_s").get<double>(),
                .mode = mode_of(json.at("uncertainty_mode").get<std::string>(), "unit"),
                .search = {},
                .budget = {},
                .seed = 1};
  const auto kind = json.at("kind").get<std::string>();
  const auto known = enum_value<WorkKind>(kind);
  if (!known) throw InputError("unit: kind '" + kind + "' is not known");
  unit.kind = *known;
  if (unit.kind == WorkKind::reference) return unit;
  unit.search = search_of(json.at("search"));
  unit.budget = budget_of(json);
  unit.seed = json.at("seed").get<std::uint64_t>();
  return unit;
}

}  // namespace

Json to_json(const Start& start) {
  const JointPosition& q = start.joints;
  return {{"base", {start.x_m, start.y_m, start.z_m, start.yaw_rad}},
          {"joints", {q.pan_rad, q.tilt_rad, q.height_m}}};
}

Json to_json(const StudySearch& search) { return nbvopt::to_json(settings(search)); }

Json to_json(const Budget& budget) {
  return {{"max_evaluations", limit_json(budget.max_evaluations)},
          {"time_limit_ms", limit_json(budget.time_limit_ms)}};
}

Start start_of(const Json& json) {
  const auto base = json.at("base").get<std::array<double, 4>>();
  const auto joints = json.at("joints").get<std::array<double, 3>>();
  return {base[0], base[1], base[2], base[3], {joints[0], joints[1], joints[2]}};
}

StudySearch search_of(const Json& json) {
  StudySearch search;
  for (const FieldSetting& setting : settings_of(json, "search")) {
    set_search(search, setting, "search");
  }
  return search;
}

Budget budget_of(const Json& json) {
  return {.max_evaluations = limit_of<std::int64_t>(json.at("max_evaluations")),
          .time_limit_ms = limit_of<double>(json.at("time_limit_ms"))};
}

UncertaintyMode mode_of(const std::string& name, const std::string& place) {
  UncertaintyMode mode{};
  const std::string demand = store(name, mode);
  if (!demand.empty()) {
    throw InputError(place + ": sensor.uncertainty_mode is '" + name + "', it must be " + demand);
  }
  return mode;
}

experiment::Unit message_of(const WorkUnit& unit) {
  const bool is_query = unit.kind == WorkKind::query;
  Json json{{"kind", enum_name(unit.kind)},
            {"map", unit.map.string()},
            {"map_digest", unit.map_digest},
            {"robot", unit.robot.string()},
            {"start", to_json(unit.start)},
            {"motion_time_s", unit.motion_time_s},
            {"uncertainty_mode", to_string(unit.mode)}};
  if (is_query) {
    json["search"] = to_json(unit.search);
    json.update(to_json(unit.budget));
    json["seed"] = unit.seed;
  }
  return {unit.id, std::move(json)};
}

WorkUnit unit_of(const Json& payload) {
  try {
    return read_unit(payload);
  } catch (const Json::exception& error) {
    throw InputError(std::string("unit: ") + error.what());
  }
}

}  // namespace nbvopt::study
