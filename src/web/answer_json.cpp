#include "web/answer_json.hpp"

#include <vector>

namespace nbvopt {
namespace {

Json matrix_json(const Transform& transform) {
  const Eigen::Matrix4d& m = transform.matrix();
  return std::vector<double>(m.data(), m.data() + m.size());
}

Json joints_json(const JointPosition& joints) {
  return {
      {"pan_rad", joints.pan_rad}, {"tilt_rad", joints.tilt_rad}, {"height_m", joints.height_m}};
}

Json view_json(const Transform& T_map_base, const Transform& T_map_sensor,
               const JointPosition& joints, double gain) {
  return {{"T_map_base", matrix_json(T_map_base)},
          {"T_map_sensor", matrix_json(T_map_sensor)},
          {"joints", joints_json(joints)},
          {"gain", gain}};
}

}  // namespace

Json camera_json(const SensorOptions& sensor) {
  return {{"half_fov_horizontal_rad", sensor.half_fov_horizontal_rad},
          {"half_fov_vertical_rad", sensor.half_fov_vertical_rad},
          {"range_min_m", sensor.range_min_m},
          {"range_max_m", sensor.range_max_m},
          {"is_range_along_axis", sensor.range_axis == RangeAxis::z_depth}};
}

Json mast_json(const MastOptions& mast) {
  return {{"pan_axis_x_m", mast.pan_axis_x_m}, {"pan_axis_y_m", mast.pan_axis_y_m}};
}

Json answer_json(const AnswerFile& answer, const Mast& mast) {
  const PlanRequest& request = answer.request;
  const MovingMast moving = moving_mast(request, mast);
  const Transform T_map_current = moving.T_map_sensor(request.joints);
  const Transform T_map_chosen = moving.T_map_sensor(answer.joints);
  const Transform T_map_arrived = T_map_chosen * mast.T_base_sensor(answer.joints).inverse();
  return {{"why", answer.why},
          {"motion_time_s", request.motion_time_s},
          {"move_time_s", mast.move_time_s(request.joints, answer.joints)},
          {"current",
           view_json(request.T_map_base, T_map_current, request.joints, answer.current_gain)},
          {"chosen", view_json(T_map_arrived, T_map_chosen, answer.joints, answer.gain)}};
}

AnswerFile answer_of(const PlanResult& result) {
  return {.request = result.request,
          .joints = result.joints,
          .gain = result.view.gain,
          .current_gain = result.current.gain,
          .why = to_string(result.status) + ": " + result.message};
}

}  // namespace nbvopt
