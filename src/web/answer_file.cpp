#include "web/answer_file.hpp"

#include "web/members.hpp"

namespace nbvopt {
namespace {

JointPosition joints(const Members& object) {
  return {.pan_rad = object.number("pan"),
          .tilt_rad = object.number("tilt"),
          .height_m = object.number("height")};
}

PlanRequest request(const Members& object) {
  const Members base = object.members("base");
  PlanRequest request;
  request.T_map_base =
      base_pose(base.number("x"), base.number("y"), base.number("z"), base.number("yaw"));
  request.joints = joints(object);
  request.motion_time_s = object.number("motion_time");
  if (object.object.contains("base_velocity")) {
    const Members velocity = object.members("base_velocity");
    request.base_twist = {velocity.number("vx"), velocity.number("vy"), velocity.number("wz")};
  }
  return request;
}

}  // namespace

AnswerFile parse_answer_file(const std::string& json, const std::string& name) {
  const Json file = parse_json(json, name);
  const Members answer{file, name, "nbvopt query --json"};
  return {.request = request(answer.members("request")),
          .joints = joints(answer),
          .gain = answer.number("gain"),
          .current_gain = answer.number("current_gain"),
          .why = answer.text("status") + ": " + answer.text("message")};
}

}  // namespace nbvopt
