#include "protocol/messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "core/enum_names.hpp"
#include "core/field_check.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "nbvopt/map/depth_image.hpp"
#include "protocol/limit_error.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

/// A needed number, checked. `is_set` and `value` are the field's.
double needed(bool is_set, double value, const std::string& field) {
  if (!is_set) throw InputError(field + " is not set");
  check_field(true, field, value, "finite");
  return value;
}

/// Rotations as far as rounding of 32-bit numbers goes; a projection would change the last bit.
Eigen::Matrix3d rotation_from(const v1::Pose& pose, const std::string& field) {
  constexpr double kRounding = 1e-5;
  if (pose.rotation_size() != 9) {
    throw InputError(field + ".rotation has " + std::to_string(pose.rotation_size()) +
                     " numbers, give 9");
  }
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation().data());
  const double deviation =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < kRounding) || rotation.determinant() < 0.0) {
    throw InputError(field + ".rotation is not a rotation matrix");
  }
  return rotation;
}

constexpr auto kStatuses = std::to_array<EnumName<PlanStatus, v1::PlanStatus>>({
    {PlanStatus::optimal_within_tolerance, v1::PLAN_STATUS_OPTIMAL_WITHIN_TOLERANCE},
    {PlanStatus::grid_complete, v1::PLAN_STATUS_GRID_COMPLETE},
    {PlanStatus::evaluation_limit, v1::PLAN_STATUS_EVALUATION_LIMIT},
    {PlanStatus::time_limit, v1::PLAN_STATUS_TIME_LIMIT},
    {PlanStatus::no_gain_in_reach, v1::PLAN_STATUS_NO_GAIN_IN_REACH},
    {PlanStatus::cancelled, v1::PLAN_STATUS_CANCELLED},
    {PlanStatus::certified, v1::PLAN_STATUS_CERTIFIED},
});

constexpr auto kFormats = std::to_array<EnumName<MapFormat, v1::MapFormat>>({
    {MapFormat::uncertainty_ot, v1::MAP_FORMAT_UNCERTAINTY_OT},
    {MapFormat::bt, v1::MAP_FORMAT_BT},
    {MapFormat::colour_ot, v1::MAP_FORMAT_COLOUR_OT},
    {MapFormat::colour_ply, v1::MAP_FORMAT_COLOUR_PLY},
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

constexpr std::size_t kPointBytes = 3 * sizeof(float);

void check_points(std::uint64_t points, std::uint64_t max_points) {
  if (points <= max_points) return;
  throw LimitError("the scan has " + std::to_string(points) + " points, the limit is " +
                   std::to_string(max_points) + " (max_scan_points)");
}

/// Points as a message packs them: the machine's own numbers, which are little-endian.
std::vector<Eigen::Vector3f> unpacked_points(const std::string& bytes, const char* field) {
  if (bytes.size() % kPointBytes != 0) {
    throw InputError(std::string(field) + " has " + std::to_string(bytes.size()) +
                     " bytes, not a multiple of 12: the scan is cut short");
  }
  std::vector<Eigen::Vector3f> points(bytes.size() / kPointBytes);
  if (!points.empty()) std::memcpy(points.front().data(), bytes.data(), bytes.size());
  return points;
}

std::string packed_points(const std::vector<Eigen::Vector3f>& points) {
  if (points.empty()) return {};
  return {reinterpret_cast<const char*>(points.front().data()), points.size() * kPointBytes};
}

Scan scan_of(const v1::PointCloud& cloud, std::uint64_t max_points) {
  check_points((cloud.xyz_m().size() + cloud.no_return_xyz().size()) / kPointBytes, max_points);
  Scan scan{.points_m = unpacked_points(cloud.xyz_m(), "points.xyz_m"),
            .colours = {},
            .no_returns = unpacked_points(cloud.no_return_xyz(), "points.no_return_xyz")};
  if (cloud.rgb().empty()) return scan;
  if (cloud.rgb().size() != 3 * scan.points_m.size()) {
    throw InputError("points.rgb has " + std::to_string(cloud.rgb().size()) +
                     " bytes, give 3 a point (" + std::to_string(3 * scan.points_m.size()) +
                     ") or none");
  }
  scan.colours.resize(scan.points_m.size());
  std::memcpy(scan.colours.front().data(), cloud.rgb().data(), cloud.rgb().size());
  return scan;
}

Scan scan_of(const v1::DepthImage& image, std::uint64_t max_points) {
  if (!image.has_width_px()) throw InputError("depth_image.width_px is not set");
  if (!image.has_height_px()) throw InputError("depth_image.height_px is not set");
  const std::uint64_t width = image.width_px();
  const std::uint64_t height = image.height_px();
  if (width == 0 || height == 0) throw InputError("depth_image has no pixels");
  check_points(width * height, max_points);
  if (width * height * sizeof(std::uint16_t) != image.depth().size()) {
    throw InputError("depth_image.depth has " + std::to_string(image.depth().size()) + " bytes, " +
                     std::to_string(width) + " x " + std::to_string(height) + " pixels take " +
                     std::to_string(width * height * sizeof(std::uint16_t)));
  }
  DepthImageOptions options{.fx_px = needed(image.has_fx_px(), image.fx_px(), "depth_image.fx_px"),
                            .fy_px = needed(image.has_fy_px(), image.fy_px(), "depth_image.fy_px"),
                            .cx_px = needed(image.has_cx_px(), image.cx_px(), "depth_image.cx_px"),
                            .cy_px = needed(image.has_cy_px(), image.cy_px(), "depth_image.cy_px")};
  if (image.has_depth_scale_m()) options.depth_scale_m = image.depth_scale_m();
  options.validate();
  Scan scan;
  std::vector<std::uint16_t> row(width);
  for (std::uint64_t v = 0; v < height; ++v) {
    const std::size_t row_bytes = width * sizeof(std::uint16_t);
    std::memcpy(row.data(), image.depth().data() + v * row_bytes, row_bytes);
    append_depth_row(row, static_cast<std::uint32_t>(v), options, scan);
  }
  return scan;
}

std::optional<std::string> set_or_none(bool is_set, const std::string& value) {
  return is_set ? std::optional(value) : std::nullopt;
}

}  // namespace

Transform from_message(const v1::Pose& pose, const std::string& field) {
  const std::array<double, 3> position_m{needed(pose.has_x_m(), pose.x_m(), field + ".x_m"),
                                         needed(pose.has_y_m(), pose.y_m(), field + ".y_m"),
                                         needed(pose.has_z_m(), pose.z_m(), field + ".z_m")};
  if (pose.rotation_size() > 0) {
    Transform T = Transform::Identity();
    T.translation() = Eigen::Vector3d(position_m[0], position_m[1], position_m[2]);
    T.linear() = rotation_from(pose, field);
    return T;
  }
  const std::array<double, 4> orientation_xyzw{needed(pose.has_qx(), pose.qx(), field + ".qx"),
                                               needed(pose.has_qy(), pose.qy(), field + ".qy"),
                                               needed(pose.has_qz(), pose.qz(), field + ".qz"),
                                               needed(pose.has_qw(), pose.qw(), field + ".qw")};
  try {
    return pose_from_quaternion(position_m, orientation_xyzw);
  } catch (const InputError& error) {
    throw InputError(field + ": " + error.what());
  }
}

Transform from_message(const v1::BasePose& base, const std::string& field) {
  switch (base.kind_case()) {
    case v1::BasePose::kPlanar: {
      const v1::PlanarPose& planar = base.planar();
      const std::string name = field + ".planar";
      const std::array<double, 4> numbers{
          needed(planar.has_x_m(), planar.x_m(), name + ".x_m"),
          needed(planar.has_y_m(), planar.y_m(), name + ".y_m"),
          needed(true, planar.z_m(), name + ".z_m"),
          needed(planar.has_yaw_rad(), planar.yaw_rad(), name + ".yaw_rad")};
      return base_pose(numbers[0], numbers[1], numbers[2], numbers[3]);
    }
    case v1::BasePose::kPose:
      return from_message(base.pose(), field + ".pose");
    case v1::BasePose::KIND_NOT_SET:
      break;
  }
  throw InputError(field + " is not set: give planar or pose");
}

JointPosition from_message(const v1::JointPosition& joints, const std::string& field) {
  return {
      .pan_rad = needed(joints.has_pan_rad(), joints.pan_rad(), field + ".pan_rad"),
      .tilt_rad = needed(joints.has_tilt_rad(), joints.tilt_rad(), field + ".tilt_rad"),
      .height_m = needed(joints.has_height_m(), joints.height_m(), field + ".height_m"),
  };
}

BaseTwist from_message(const v1::BaseTwist& twist, const std::string& field) {
  return {.vx_m_s = needed(twist.has_vx_m_s(), twist.vx_m_s(), field + ".vx_m_s"),
          .vy_m_s = needed(twist.has_vy_m_s(), twist.vy_m_s(), field + ".vy_m_s"),
          .wz_rad_s = needed(twist.has_wz_rad_s(), twist.wz_rad_s(), field + ".wz_rad_s")};
}

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

MapFormat from_message(v1::MapFormat format) {
  if (format == v1::MAP_FORMAT_UNSPECIFIED) return MapFormat::uncertainty_ot;
  if (const auto own = value_in(kFormats, format)) return *own;
  throw InputError("format is " + std::to_string(format) + ", which is no map format");
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

Transform from_message(const v1::View& view, const Mast& mast, const std::string& field) {
  switch (view.kind_case()) {
    case v1::View::kSensor:
      return from_message(view.sensor(), field + ".sensor");
    case v1::View::kMounted: {
      const std::string name = field + ".mounted";
      return from_message(view.mounted().base(), name + ".base") *
             mast.T_base_sensor(from_message(view.mounted().joints(), name + ".joints"));
    }
    case v1::View::KIND_NOT_SET:
      break;
  }
  throw InputError(field + " is not set: give sensor or mounted");
}

Scan scan_from_message(const v1::InsertScanRequest& request, std::uint64_t max_points) {
  switch (request.scan_case()) {
    case v1::InsertScanRequest::kPoints:
      return scan_of(request.points(), max_points);
    case v1::InsertScanRequest::kDepthImage:
      return scan_of(request.depth_image(), max_points);
    case v1::InsertScanRequest::SCAN_NOT_SET:
      break;
  }
  throw InputError("scan is not set: give points or depth_image");
}

v1::Pose to_message(const Transform& T) {
  v1::Pose pose;
  const Eigen::Vector3d p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  pose.set_x_m(p.x());
  pose.set_y_m(p.y());
  pose.set_z_m(p.z());
  pose.set_qx(q.x());
  pose.set_qy(q.y());
  pose.set_qz(q.z());
  pose.set_qw(q.w());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.add_rotation(T.linear()(row, column));
  }
  return pose;
}

v1::JointPosition to_message(const JointPosition& joints) {
  v1::JointPosition message;
  message.set_pan_rad(joints.pan_rad);
  message.set_tilt_rad(joints.tilt_rad);
  message.set_height_m(joints.height_m);
  return message;
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

v1::MapFormat to_message(MapFormat format) {
  return name_in(kFormats, format).value_or(v1::MAP_FORMAT_UNSPECIFIED);
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

v1::PointCloud to_message(const Scan& scan) {
  v1::PointCloud cloud;
  cloud.set_xyz_m(packed_points(scan.points_m));
  cloud.set_no_return_xyz(packed_points(scan.no_returns));
  if (!scan.colours.empty()) {
    cloud.set_rgb(std::string(reinterpret_cast<const char*>(scan.colours.front().data()),
                              3 * scan.colours.size()));
  }
  return cloud;
}

}  // namespace nbvopt
