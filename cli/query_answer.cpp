#include "cli/query_answer.hpp"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numbers>

#include "nbvopt/gain/hazard_file.hpp"

namespace nbvopt {
namespace {

Json pose_json(const Transform& T_map_sensor) {
  const Eigen::Vector3d p = T_map_sensor.translation();
  const Eigen::Quaterniond q(T_map_sensor.linear());
  return {{"position", {p.x(), p.y(), p.z()}}, {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

double yaw_rad(const Transform& T_map_base) {
  return std::atan2(T_map_base.linear()(1, 0), T_map_base.linear()(0, 0));
}

Json base_json(const Transform& T_map_base) {
  const Eigen::Vector3d p = T_map_base.translation();
  return {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}, {"yaw", yaw_rad(T_map_base)}};
}

/// The question, as far as it says where robot and joints were.
Json request_json(const PlanRequest& request) {
  Json json{{"base", base_json(request.T_map_base)},
            {"pan", request.joints.pan_rad},
            {"tilt", request.joints.tilt_rad},
            {"height", request.joints.height_m},
            {"motion_time", request.motion_time_s}};
  if (!request.base_twist.is_zero()) {
    json["base_velocity"] = {{"vx", request.base_twist.vx_m_s},
                             {"vy", request.base_twist.vy_m_s},
                             {"wz", request.base_twist.wz_rad_s}};
  }
  return json;
}

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char buffer[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return std::string(buffer) + '\n';
}

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string gain_line(const PlanResult& result) {
  const double more = result.view.gain - result.current.gain;
  if (result.current.gain <= 0.0) {
    return line("gain    %.1f, staying gives %.1f", result.view.gain, result.current.gain);
  }
  return line("gain    %.1f, staying gives %.1f (%+.1f %%)", result.view.gain, result.current.gain,
              100.0 * more / result.current.gain);
}

std::string evaluation_count(const PlanResult& result) {
  std::string text = std::to_string(result.evaluations) +
                     (result.evaluations == 1 ? " evaluation" : " evaluations");
  if (result.surrogate_evaluations > 0) {
    text += " and " + std::to_string(result.surrogate_evaluations) + " of the surrogate";
  }
  return text;
}

/// Gains by name have no parts of the paper's gain.
std::string sees_line(const ViewGain& view) {
  if (view.gain > 0.0 && view.unknown_gain == 0.0 && view.occupied_gain == 0.0) {
    return line("sees    %d rays end unknown, %d occupied, %d free", view.unknown_rays,
                view.occupied_rays, view.free_rays);
  }
  return line("sees    %d rays end unknown (gain %.1f), %d occupied (gain %.1f), %d free",
              view.unknown_rays, view.unknown_gain, view.occupied_rays, view.occupied_gain,
              view.free_rays);
}

/// What was spent besides the search.
std::string cost(const QueryAnswer& answer) {
  std::array<char, 96> text{};
  if (answer.remote) {
    std::snprintf(text.data(), text.size(), "map version %llu, call %.1f ms",
                  static_cast<unsigned long long>(answer.result.map_version),
                  answer.remote->call_ms);
  } else {
    std::snprintf(text.data(), text.size(), "map read %.1f ms, grid %.1f ms", answer.map_load_ms,
                  answer.result.grid_ms);
  }
  return text.data();
}

}  // namespace

Json to_json(const QueryAnswer& answer) {
  const PlanResult& result = answer.result;
  Json json{{"pan", result.joints.pan_rad},
            {"tilt", result.joints.tilt_rad},
            {"height", result.joints.height_m},
            {"pan_wrapped", wrap_angle(result.joints.pan_rad)},
            {"gain", result.view.gain},
            {"current_gain", result.current.gain},
            {"unknown_gain", result.view.unknown_gain},
            {"occupied_gain", result.view.occupied_gain},
            {"unknown_rays", result.view.unknown_rays},
            {"occupied_rays", result.view.occupied_rays},
            {"free_rays", result.view.free_rays},
            {"status", to_string(result.status)},
            {"message", result.message},
            {"evaluations", result.evaluations},
            {"surrogate_evaluations", result.surrogate_evaluations},
            {"time_ms", result.search_time_ms},
            {"move_time_s", result.move_time_s},
            {"solver", result.solver},
            {"seed", result.seed},
            {"evaluator", answer.evaluator},
            {"counting", to_string(answer.counting)},
            {"active_bounds", result.active_bounds},
            {"warnings", result.warnings},
            {"pose", pose_json(result.T_map_sensor)},
            {"request", request_json(result.request)}};
  if (!answer.result.request.base_twist.is_zero()) {
    json["base_on_arrival"] = base_json(result.T_map_base);
  }
  if (result.hazards) json["hazards"] = Json::parse(hazards_json(*result.hazards));
  if (result.certificate) {
    json["upper_bound"] = result.certificate->upper_bound;
    json["gap"] = result.certificate->gap();
    json["certify_ms"] = result.certificate->time_ms;
  }
  if (answer.remote) {
    json["server"] = answer.remote->server;
    json["call_ms"] = answer.remote->call_ms;
    json["map_version"] = result.map_version;
  } else {
    json["map_load_ms"] = answer.map_load_ms;
    json["grid_ms"] = result.grid_ms;
  }
  return json;
}

std::string to_text(const QueryAnswer& answer) {
  const PlanResult& result = answer.result;
  const JointPosition& q = result.joints;
  const Eigen::Vector3d p = result.T_map_sensor.translation();
  const Eigen::Vector3d forward = result.T_map_sensor.linear().col(2);
  const double limit_s = answer.result.request.motion_time_s;

  std::string text =
      line("look    pan %.3f rad (%.1f deg), tilt %.3f rad (%.1f deg), height %.3f m", q.pan_rad,
           degrees(q.pan_rad), q.tilt_rad, degrees(q.tilt_rad), q.height_m);
  text += line("from    %.3f, %.3f, %.3f m in the map, along %.3f, %.3f, %.3f", p.x(), p.y(), p.z(),
               forward.x(), forward.y(), forward.z());
  text += gain_line(result);
  text += sees_line(result.view);
  if (result.hazards) {
    text += line("unknown judged by what %.0f m of rays met, prior included",
                 result.hazards->total().metres);
  }
  if (result.certificate) {
    const Certificate& certificate = *result.certificate;
    text += line("bound   %.1f: no view in reach gains more, this one %.2f %% of it (%.0f ms)",
                 certificate.upper_bound, 100.0 * (1.0 - certificate.gap()), certificate.time_ms);
  }
  text += "why     " + to_string(result.status) + ": " + result.message + '\n';
  if (!result.active_bounds.empty()) text += "bounds  " + joined(result.active_bounds) + '\n';
  text += limit_s > 0.0 ? line("move    %.2f s of %.2f s", result.move_time_s, limit_s)
                        : line("move    %.2f s, no limit", result.move_time_s);
  if (!answer.result.request.base_twist.is_zero()) {
    const Eigen::Vector3d base_m = result.T_map_base.translation();
    text += line("base    at %.3f, %.3f, %.3f m in the map, yaw %.3f rad, when the joints arrive",
                 base_m.x(), base_m.y(), base_m.z(), yaw_rad(result.T_map_base));
  }
  text += line("took    %.1f ms for %s (%s, %s, %s); %s", result.search_time_ms,
               evaluation_count(result).c_str(), result.solver.c_str(), answer.evaluator.c_str(),
               to_string(answer.counting).c_str(), cost(answer).c_str());
  return text;
}

}  // namespace nbvopt
