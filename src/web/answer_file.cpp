#include "web/answer_file.hpp"

#include "core/json.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

const Json& member(const Json& object, const char* key, const std::string& where) {
  const auto found = object_in(object, where).find(key);
  if (found == object.end()) {
    throw InputError(where + ": '" + key + "' is missing, give what nbvopt query --json wrote");
  }
  return *found;
}

double number(const Json& object, const char* key, const std::string& where) {
  return number_in(member(object, key, where), where + ": '" + key + "'");
}

std::string text(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  if (!value.is_string()) throw InputError(where + ": '" + key + "' must be a text");
  return value.get<std::string>();
}

JointPosition joints(const Json& object, const std::string& where) {
  return {.pan_rad = number(object, "pan", where),
          .tilt_rad = number(object, "tilt", where),
          .height_m = number(object, "height", where)};
}

PlanRequest request(const Json& object, const std::string& where) {
  const Json& base = member(object, "base", where);
  const std::string where_base = where + ".base";
  PlanRequest request;
  request.T_map_base = base_pose(number(base, "x", where_base), number(base, "y", where_base),
                                 number(base, "z", where_base), number(base, "yaw", where_base));
  request.joints = joints(object, where);
  request.motion_time_s = number(object, "motion_time", where);
  if (object.contains("base_velocity")) {
    const Json& velocity = object["base_velocity"];
    const std::string where_velocity = where + ".base_velocity";
    request.base_twist = {number(velocity, "vx", where_velocity),
                          number(velocity, "vy", where_velocity),
                          number(velocity, "wz", where_velocity)};
  }
  return request;
}

}  // namespace

AnswerFile parse_answer_file(const std::string& json, const std::string& name) {
  const Json answer = parse_json(json, name);
  return {.request = request(member(answer, "request", name), name + ": request"),
          .joints = joints(answer, name),
          .gain = number(answer, "gain", name),
          .current_gain = number(answer, "current_gain", name),
          .why = text(answer, "status", name) + ": " + text(answer, "message", name)};
}

}  // namespace nbvopt
