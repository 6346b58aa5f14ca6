#include "planner/pose_file.hpp"

#include <algorithm>
#include <array>

#include "core/json.hpp"
#include "fields/json.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/planner/robot_fields.hpp"

namespace nbvopt {
namespace {

const Json& member(const Json& object, const char* key, const std::string& where) {
  const auto found = object_in(object, where).find(key);
  if (found == object.end()) throw InputError(where + ": '" + key + "' is missing");
  return *found;
}

double number(const Json& object, const char* key, const std::string& where) {
  return number_in(member(object, key, where), where + ": '" + key + "'");
}

template <std::size_t Size>
std::array<double, Size> numbers(const Json& object, const char* key, const std::string& where) {
  const Json& value = member(object, key, where);
  const auto is_number = [](const Json& element) { return element.is_number(); };
  if (!value.is_array() || value.size() != Size ||
      !std::all_of(value.begin(), value.end(), is_number)) {
    throw InputError(where + ": '" + key + "' must be a list of " + std::to_string(Size) +
                     " numbers");
  }
  return value.get<std::array<double, Size>>();
}

Transform pose_of_base(const Json& a_case, const Mast& mast, const std::string& where) {
  const Json& base = member(a_case, "base", where);
  const std::string where_base = where + ".base";
  PlanRequest request;
  request.T_map_base = base_pose(number(base, "x", where_base), number(base, "y", where_base),
                                 base.contains("z") ? number(base, "z", where_base) : 0.0,
                                 number(base, "yaw", where_base));
  return T_map_sensor(request, mast,
                      {.pan_rad = number(a_case, "pan", where),
                       .tilt_rad = number(a_case, "tilt", where),
                       .height_m = number(a_case, "height", where)});
}

Transform pose(const Json& a_case, const Mast& mast, const std::string& where) {
  if (object_in(a_case, where).contains("position") || a_case.contains("orientation_xyzw")) {
    const auto position_m = numbers<3>(a_case, "position", where);
    const auto orientation_xyzw = numbers<4>(a_case, "orientation_xyzw", where);
    try {
      return pose_from_quaternion(position_m, orientation_xyzw);
    } catch (const InputError& error) {
      throw InputError(where + ": " + error.what());
    }
  }
  if (a_case.contains("base")) return pose_of_base(a_case, mast, where);
  throw InputError(where +
                   ": a pose is missing, give 'position' and 'orientation_xyzw', or 'base' with "
                   "'pan', 'tilt' and 'height'");
}

}  // namespace

PoseFile parse_pose_file(const std::string& json, const std::string& name, const Robot& robot) {
  const Json file = parse_json(json, name);
  const Json& cases = member(file, "cases", name);
  if (!cases.is_array()) throw InputError(name + ": 'cases' must be a list [...]");

  PoseFile result{robot.sensor, {}};
  if (file.contains("sensor")) {
    set_fields(result.sensor, settings_of(file["sensor"], name + ": sensor"), name);
  }
  const Mast mast(robot.mast);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string where = name + ": cases[" + std::to_string(i) + "]";
    result.poses_T_map_sensor.push_back(pose(cases[i], mast, where));
  }
  return result;
}

}  // namespace nbvopt
