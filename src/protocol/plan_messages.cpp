#include "protocol/plan_messages.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/enum_names.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "protocol/needed_field.hpp"
#include "protocol/pose_messages.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

constexpr auto kStatuses = std::to_array<EnumName<PlanStatus, v1::PlanStatus>>({
    {PlanStatus::optimal_within_tolerance, v1::PLAN_STATUS_OPTIMAL_WITHIN_TOLERANCE},
    {PlanStatus::grid_complete, v1::PLAN_STATUS_GRID_COMPLETE},
    {PlanStatus::evaluation_limit, v1::PLAN_STATUS_EVALUATION_LIMIT},
    {PlanStatus::time_limit, v1::PLAN_STATUS_TIME_LIMIT},
    {PlanStatus::no_gain_in_reach, v1::PLAN_STATUS_NO_GAIN_IN_REACH},
    {PlanStatus::cancelled, v1::PLAN_STATUS_CANCELLED},
    {PlanStatus::certified, v1::PLAN_STATUS_CERTIFIED},
});

CertifyOptions from_message(const v1::CertifyOptions& message) {
  CertifyOptions options;
  if (message.has_gap()) options.gap = message.gap();
  if (message.has_time_limit_ms()) options.time_limit_ms = message.time_limit_ms();
  return options;
}

Certificate from_message(const v1::Certificate& message) {
  return {.upper_bound = message.upper_bound(),
          .gain = message.gain(),
          .cones = message.cones(),
          .improvements = message.improvements(),
          .time_ms = message.time_ms()};
}

v1::CertifyOptions to_message(const CertifyOptions& options) {
  v1::CertifyOptions message;
  message.set_gap(options.gap);
  message.set_time_limit_ms(options.time_limit_ms);
  return message;
}

v1::Certificate to_message(const Certificate& certificate) {
  v1::Certificate message;
  message.set_upper_bound(certificate.upper_bound);
  message.set_gain(certificate.gain);
  message.set_gap(certificate.gap());
  message.set_cones(certificate.cones);
  message.set_improvements(certificate.improvements);
  message.set_time_ms(certificate.time_ms);
  return message;
}

std::optional<std::string> set_or_none(bool is_set, const std::string& value) {
  return is_set ? std::optional(value) : std::nullopt;
}

}  // namespace

Search from_message(const v1::Search& search) {
  return {.solver = set_or_none(search.has_solver(), search.solver()),
          .stages = named_stages(set_or_none(search.has_global(), search.global()),
                                 set_or_none(search.has_local(), search.local()),
                                 set_or_none(search.has_polish(), search.polish())),
          .grid_steps = {search.grid_steps().begin(), search.grid_steps().end()}};
}

ViewGain from_message(const v1::ViewGain& view) {
  return {.gain = view.gain(),
          .unknown_gain = view.unknown_gain(),
          .occupied_gain = view.occupied_gain(),
          .unknown_rays = view.unknown_rays(),
          .occupied_rays = view.occupied_rays(),
          .free_rays = view.free_rays()};
}

PlanRequest from_message(const v1::PlanRequest& message) {
  PlanRequest request;
  request.T_map_base = from_message(message.base(), "base");
  request.joints = from_message(message.joints(), "joints");
  request.motion_time_s =
      needed(message.has_motion_time_s(), message.motion_time_s(), "motion_time_s");
  if (message.has_base_twist()) {
    request.base_twist = from_message(message.base_twist(), "base_twist");
  }
  for (int i = 0; i < message.base_path_size(); ++i) {
    const v1::TimedPose& pose = message.base_path(i);
    const std::string field = "base_path[" + std::to_string(i) + ']';
    request.base_path.push_back(
        {.time_s = needed(pose.has_time_s(), pose.time_s(), field + ".time_s"),
         .T_map_base = from_message(pose.base(), field + ".base")});
  }
  if (message.has_certify()) request.certify = from_message(message.certify());
  if (message.has_min_gain()) request.min_gain = needed(true, message.min_gain(), "min_gain");
  if (message.has_seed()) request.seed = message.seed();
  if (message.has_max_evaluations()) {
    request.stop.max_evaluations = message.max_evaluations();
    if (message.max_evaluations() < 1) {
      throw InputError("max_evaluations is " + std::to_string(message.max_evaluations()) +
                       ", it must be at least 1");
    }
  }
  return request;
}

GainChoice gain_from_text(const std::string& text, const std::string& field) {
  constexpr std::size_t kMost = 1000;
  if (text.size() > kMost) {
    throw InputError(field + " has " + std::to_string(text.size()) + " letters, at most " +
                     std::to_string(kMost) + " are read");
  }
  GainChoice gain;
  const std::string demand = store(text, gain);
  if (!demand.empty()) throw InputError(field + " '" + text + "' must be " + demand);
  return gain;
}

std::optional<HazardTable> from_message(
    const google::protobuf::RepeatedPtrField<v1::HazardCount>& counts, double floor_map_m) {
  if (counts.empty()) return std::nullopt;
  HazardTable hazards(floor_map_m);
  const std::vector<std::string> names = hazard_context_names();
  for (const v1::HazardCount& count : counts) {
    const auto context = std::ranges::find(names, count.context());
    if (context == names.end()) continue;  // of a newer server
    hazards.set(static_cast<std::size_t>(context - names.begin()),
                {.hits = count.hits(), .metres = count.metres()});
  }
  return hazards;
}

PlanStatus from_message(v1::PlanStatus status) {
  return value_in(kStatuses, status).value_or(PlanStatus::not_run);
}

PlanResult from_message(const v1::PlanReply& reply) {
  PlanResult result;
  result.status = from_message(reply.status());
  result.message = reply.message();
  result.joints = from_message(reply.joints(), "joints");
  result.T_map_sensor = from_message(reply.sensor(), "sensor");
  result.T_map_base = from_message(reply.base(), "base");
  result.view = from_message(reply.view());
  result.current = from_message(reply.current());
  result.move_time_s = reply.move_time_s();
  if (reply.box_min_size() == 3 && reply.box_max_size() == 3) {
    result.box = {.min = Eigen::Map<const Eigen::Vector3d>(reply.box_min().data()),
                  .max = Eigen::Map<const Eigen::Vector3d>(reply.box_max().data())};
  }
  result.active_bounds = {reply.active_bounds().begin(), reply.active_bounds().end()};
  result.evaluations = reply.evaluations();
  result.surrogate_evaluations = reply.surrogate_evaluations();
  result.search_time_ms = reply.search_time_ms();
  result.solver = reply.solver();
  result.seed = reply.seed();
  result.map_version = reply.map_version();
  result.hazards = from_message(reply.hazards(), 0.0);
  if (reply.has_certificate()) result.certificate = from_message(reply.certificate());
  result.warnings = {reply.warnings().begin(), reply.warnings().end()};
  return result;
}

v1::Search to_message(const Search& search) {
  v1::Search message;
  if (search.solver) message.set_solver(*search.solver);
  if (search.stages) {
    message.set_global(stage_name(search.stages->global));
    message.set_local(stage_name(search.stages->local));
    message.set_polish(stage_name(search.stages->polish));
  }
  for (const double step : search.grid_steps) message.add_grid_steps(step);
  if (from_message(message) != search) {
    throw InputError(
        "search: a server takes solver, grid_steps and the stages' solvers, leave its other "
        "parameters at their defaults");
  }
  return message;
}

v1::ViewGain to_message(const ViewGain& view) {
  v1::ViewGain message;
  message.set_gain(view.gain);
  message.set_unknown_gain(view.unknown_gain);
  message.set_occupied_gain(view.occupied_gain);
  message.set_unknown_rays(view.unknown_rays);
  message.set_occupied_rays(view.occupied_rays);
  message.set_free_rays(view.free_rays);
  return message;
}

v1::PlanRequest to_message(const PlanRequest& request) {
  v1::PlanRequest message;
  *message.mutable_base()->mutable_pose() = to_message(request.T_map_base);
  *message.mutable_joints() = to_message(request.joints);
  message.set_motion_time_s(request.motion_time_s);
  if (request.min_gain) message.set_min_gain(*request.min_gain);
  message.set_seed(request.seed);
  if (!request.base_twist.is_zero()) {
    v1::BaseTwist& twist = *message.mutable_base_twist();
    twist.set_vx_m_s(request.base_twist.vx_m_s);
    twist.set_vy_m_s(request.base_twist.vy_m_s);
    twist.set_wz_rad_s(request.base_twist.wz_rad_s);
  }
  for (const TimedPose& pose : request.base_path) {
    v1::TimedPose& timed = *message.add_base_path();
    timed.set_time_s(pose.time_s);
    *timed.mutable_base()->mutable_pose() = to_message(pose.T_map_base);
  }
  if (request.certify) *message.mutable_certify() = to_message(*request.certify);
  if (request.stop.max_evaluations != StopRule{}.max_evaluations) {
    message.set_max_evaluations(request.stop.max_evaluations);
  }
  return message;
}

v1::PlanStatus to_message(PlanStatus status) {
  return name_in(kStatuses, status).value_or(v1::PLAN_STATUS_UNSPECIFIED);
}

v1::PlanReply to_message(const PlanResult& result) {
  v1::PlanReply reply;
  reply.set_status(to_message(result.status));
  reply.set_message(result.message);
  *reply.mutable_joints() = to_message(result.joints);
  *reply.mutable_sensor() = to_message(result.T_map_sensor);
  *reply.mutable_base() = to_message(result.T_map_base);
  *reply.mutable_view() = to_message(result.view);
  *reply.mutable_current() = to_message(result.current);
  reply.set_move_time_s(result.move_time_s);
  for (const double x : result.box.min) reply.add_box_min(x);
  for (const double x : result.box.max) reply.add_box_max(x);
  for (const std::string& name : result.active_bounds) reply.add_active_bounds(name);
  reply.set_evaluations(result.evaluations);
  reply.set_surrogate_evaluations(result.surrogate_evaluations);
  reply.set_search_time_ms(result.search_time_ms);
  reply.set_solver(result.solver);
  reply.set_seed(result.seed);
  reply.set_map_version(result.map_version);
  if (result.hazards) add_to(*reply.mutable_hazards(), *result.hazards);
  if (result.certificate) *reply.mutable_certificate() = to_message(*result.certificate);
  for (const std::string& warning : result.warnings) reply.add_warnings(warning);
  return reply;
}

void add_to(google::protobuf::RepeatedPtrField<v1::HazardCount>& counts,
            const HazardTable& hazards) {
  const std::vector<std::string> names = hazard_context_names();
  for (std::size_t context = 0; context < names.size(); ++context) {
    v1::HazardCount& count = *counts.Add();
    count.set_context(names[context]);
    count.set_hits(hazards.count(context).hits);
    count.set_metres(hazards.count(context).metres);
  }
}

}  // namespace nbvopt
