// The ways in which an episode moves the camera.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "nbvopt/planner/view_planner.hpp"

namespace nbvopt {

/// Where the camera goes next.
struct NextView {
  JointPosition joints;
  double predicted_gain = std::numeric_limits<double>::quiet_NaN();  ///< NaN: nobody asked
};

/// What a view will truly bring at the next capture, as Capture::realised_gain has it: found by
/// looking there, so only a mode that cheats asks.
using TrueGain = std::function<double(const JointPosition&)>;

/// Const and safe to share between threads.
class CameraMode {
 public:
  virtual ~CameraMode() = default;

  /// Whether next_view() wants a planner; without one it is not called, and the camera stays.
  virtual bool plans() const { return true; }

  /// Chooses within reach of the request.
  virtual NextView next_view(const ViewPlanner& planner, const PlanRequest& request,
                             const TrueGain& true_gain) const = 0;
};

/// The modes by name:
///   static   the camera stays
///   grid     the paper's search: pan only, steps of 0.8 rad
///   grid-3   the paper's search over three joints: steps of 0.4 rad, 0.25 rad and 0.075 m
///   auto     the continuous search
///   random   any view in reach, each as likely as another: what motion alone brings
///   oracle   of staying and 100 random views the one that truly brings the most: it cheats, and
///            bounds what choosing one view at a time can bring
std::vector<std::string> camera_mode_names();

/// Throws UsageError that lists the names when `name` is not one of them.
std::unique_ptr<CameraMode> make_camera_mode(const std::string& name);

}  // namespace nbvopt
