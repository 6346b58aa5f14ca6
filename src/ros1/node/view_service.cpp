#include "ros1/node/view_service.hpp"

#include <cmath>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "ros1/node/conversions.hpp"

namespace nbvopt {
namespace {

constexpr double kBetweenWarnings_s = 10.0;
constexpr double kScanTimeout_s = 1.0;  // clouds of a slow camera come once a second

}  // namespace

ViewService::ViewService(ros::NodeHandle& node, ros::NodeHandle& service_node,
                         const NodeParameters& parameters, const tf2_ros::Buffer& tf,
                         MapStore& store, Joints& joints, ScanInput& scans)
    : parameters_(parameters), tf_(tf), store_(store), joints_(joints), scans_(scans) {
  path_subscriber_ =
      node.subscribe<nav_msgs::Path>("base_path", 1, [this](const nav_msgs::Path::ConstPtr& path) {
        const std::scoped_lock lock(mutex_);
        path_ = path;
      });
  service_ = service_node.advertiseService("optimize_current_pose", &ViewService::optimize, this);
}

bool ViewService::optimize(Request& request, Response& response) {
  const ros::WallTime begin = ros::WallTime::now();
  try {
    const PlanRequest question = request_now(request.time);
    warn_of_other_mast(question);
    const PlanResult look = store_.published()->plan(question);
    joints_.move_to(look.joints, look.move_time_s);
    response.pose = pose_message(look.T_map_sensor);
    response.pan = static_cast<float>(look.joints.pan_rad);
    response.message = look.message;
    response.success = 1;
    const double planned_ms = 1e3 * (ros::WallTime::now() - begin).toSec();
    wait_for_view(look, response);
    ROS_INFO("optimize_current_pose: %s; commanded after %.0f ms, answered after %.0f ms",
             response.message.c_str(), planned_ms, 1e3 * (ros::WallTime::now() - begin).toSec());
    return true;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  response.success = 0;
  response.pose.orientation.w = 1.0;
  ROS_WARN("optimize_current_pose: %s", response.message.c_str());
  return true;
}

PlanRequest ViewService::request_now(double motion_time_s) const {
  if (!std::isfinite(motion_time_s) || motion_time_s < 0.0) {
    throw InputError("time is " + format_number(motion_time_s) +
                     " s, it must be finite and not negative (0: no limit)");
  }
  PlanRequest request;
  request.T_map_base = look_up(tf_, parameters_.map_frame, parameters_.base_frame);
  request.joints = joints_.now();
  request.motion_time_s = motion_time_s;
  request.stop = StopRule::within(parameters_.time_limit_ms);
  if (motion_time_s > 0.0) request.base_path = base_path();
  return request;
}

std::vector<TimedPose> ViewService::base_path() const {
  nav_msgs::Path::ConstPtr path;
  {
    const std::scoped_lock lock(mutex_);
    path = path_;
  }
  std::vector<TimedPose> ahead;
  if (path == nullptr || path->poses.empty()) return ahead;
  const Transform T_map_path = look_up(tf_, parameters_.map_frame, path->header.frame_id);
  // Planners of ways stamp all poses alike: then a speed tells the times.
  const bool has_times = path->poses.front().header.stamp < path->poses.back().header.stamp;
  if (!has_times && parameters_.path_speed_m_s == 0.0) {
    ROS_WARN_THROTTLE(kBetweenWarnings_s,
                      "the poses of base_path tell no times and path_speed is not set: the base is "
                      "taken to stand");
    return ahead;
  }
  const ros::Time now = ros::Time::now();
  double length_m = 0.0;
  Transform before = Transform::Identity();
  for (const auto& stamped : path->poses) {
    TimedPose pose;
    pose.T_map_base = T_map_path * transform_of(stamped.pose);
    if (&stamped != &path->poses.front()) {
      length_m += (pose.T_map_base.translation() - before.translation()).norm();
    }
    before = pose.T_map_base;
    const ros::Time start = path->header.stamp;
    pose.time_s = has_times ? (stamped.header.stamp - now).toSec()
                            : (start - now).toSec() + length_m / parameters_.path_speed_m_s;
    const bool is_later = ahead.empty() || pose.time_s > ahead.back().time_s;
    if (pose.time_s > 0.0 && is_later) ahead.push_back(pose);
  }
  return ahead;
}

void ViewService::wait_for_view(const PlanResult& look, Response& response) {
  if (parameters_.arrival_timeout_s == 0.0) return;
  const auto arrived =
      joints_.wait_until_at(look.joints, look.move_time_s + parameters_.arrival_timeout_s);
  if (!arrived) {
    response.success = 0;
    response.message += "; the joints had not arrived " +
                        format_number(parameters_.arrival_timeout_s) + " s after they should have";
  } else if (!scans_.wait_for_scan_since(*arrived, kScanTimeout_s)) {
    response.message += "; no cloud has come from there";
  }
}

/// A mast that is not what tf says plans for views that the camera then does not have.
void ViewService::warn_of_other_mast(const PlanRequest& request) const {
  if (parameters_.sensor_frame.empty()) return;
  const Transform T_base_sensor_tf = look_up(tf_, parameters_.base_frame, parameters_.sensor_frame);
  const Transform difference =
      Mast(parameters_.robot.mast).T_base_sensor(request.joints).inverse() * T_base_sensor_tf;
  const double distance_m = difference.translation().norm();
  const double angle_rad = Eigen::AngleAxisd(difference.rotation()).angle();
  constexpr double kMost_m = 0.05;
  constexpr double kMost_rad = 0.1;
  if (distance_m <= kMost_m && angle_rad <= kMost_rad) return;
  ROS_WARN_THROTTLE(kBetweenWarnings_s,
                    "by tf the camera is %.2f m and %.2f rad away from where the mast has it: do "
                    "robot, base_frame and sensor_frame fit?",
                    distance_m, angle_rad);
}

}  // namespace nbvopt
