#include "planner/plan_message.hpp"

#include <algorithm>
#include <cmath>

#include "core/number.hpp"

namespace nbvopt {
namespace {

std::string one_decimal(double value) { return format_number(std::round(value * 10.0) / 10.0); }

std::string sources(const ViewGain& view) {
  const double gain = view.unknown_gain + view.occupied_gain;
  if (!(gain > 0.0)) return "";
  const double unknown_percent = std::round(100.0 * view.unknown_gain / gain);
  return "; " + format_number(unknown_percent) + " % of it from unknown space, " +
         format_number(100.0 - unknown_percent) + " % from badly seen surfaces";
}

std::string joints_at_limits(const std::vector<std::string>& active_bounds) {
  std::vector<std::string> joints;
  for (const Joint joint : kJoints) {
    const auto is_of_joint = [&](const std::string& bound) {
      return bound.starts_with(to_string(joint));
    };
    if (std::any_of(active_bounds.begin(), active_bounds.end(), is_of_joint)) {
      joints.push_back(to_string(joint));
    }
  }
  if (joints.empty()) return "";
  if (joints.size() == 1) return "; " + joints[0] + " is at its limit";
  std::string text = "; " + joints[0];
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) text += ", " + joints[i];
  return text + " and " + joints.back() + " are at their limits";
}

}  // namespace

std::string gain_message(const PlanResult& result) {
  const double more = result.view.gain - result.current.gain;
  const std::string what =
      more > 0.0 ? "move: gain " + one_decimal(result.view.gain) + ", " + one_decimal(more) +
                       " more than staying"
                 : "stay: no evaluated view is better, gain " + one_decimal(result.view.gain);
  return what + sources(result.view) + joints_at_limits(result.active_bounds);
}

std::string no_gain_message(VoxelState at_camera, const ViewGain& view) {
  if (at_camera == VoxelState::occupied) return "stay: the sensor is inside an obstacle";
  if (view.unknown_rays + view.occupied_rays == 0) {
    return "stay: in the best view all rays end in free space or are blocked nearby";
  }
  return "stay: what the best view would see is known well enough";
}

}  // namespace nbvopt
