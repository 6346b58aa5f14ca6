// One episode of the paper's experiment: the base follows a recorded trajectory while the camera
// captures, the map grows, and the next view is planned (Fig. 4).
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/camera_mode.hpp"
#include "nbvopt/sim/information_growth.hpp"
#include "nbvopt/sim/localisation.hpp"
#include "nbvopt/sim/map_score.hpp"
#include "nbvopt/sim/people.hpp"
#include "nbvopt/sim/prediction_record.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"

namespace nbvopt {

struct EpisodeOptions {
  Robot robot;
  JointPosition start_joints{.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
  double motion_time_s = 0.5;        ///< t: from one capture to the next, whatever the mode
  std::optional<double> capture_hz;  ///< also captures while the joints move, so often
  /// Whether the clock runs on while the map is updated and the next view is planned; otherwise
  /// that takes no time, and the same episode gives the same map on every machine.
  bool charge_computing = false;
  double range_noise_m = 0.0;  ///< standard deviation
  LocalisationOptions localisation = {};
  /// Whether the map is judged by the world in the end. Where poses err, the same views are then
  /// entered from their true poses into a second map.
  bool scores_map = false;
  /// What an expected gain begins with; none: nothing is learnt, the floor is that of the start.
  std::optional<HazardTable> hazards;
  std::uint64_t seed = 1;  ///< of noise, of people, and with the capture's number of modes' draws
  People people = {};      ///< who walk meanwhile, round the robot; the camera sees them

  /// Throws InputError that names the first bad value: a motion time or rate that is not positive,
  /// joints beyond their limits, a bad robot, noise or localisation.
  void validate() const;
};

/// One capture, and what was planned on the map with it.
struct Capture {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  std::uint64_t frame = 0;
  double time_s = 0.0;
  Transform T_map_base = Transform::Identity();    ///< as the base believes
  Transform T_world_base = Transform::Identity();  ///< in truth: the same unless poses err
  JointPosition joints;
  bool is_on_the_way = false;  ///< taken while joints move to a view that was planned
  std::uint64_t points_used = 0;
  std::uint64_t voxels = 0;       ///< of the map: occupied with u < 1, this capture included
  double information = 0.0;       ///< of the map, Eq. 11, this capture included
  double information_gain = 0.0;  ///< what this capture added
  /// Occupied voxels of the map where the static world has nothing; not counted without people.
  std::optional<std::uint64_t> ghosts = {};
  double predicted_gain = kNaN;  ///< of this view when it was planned; NaN: it was not
  /// Of this view in the same unit, on the map as it was just before; NaN where it was not planned.
  double realised_gain = kNaN;
  double motion_time_s = 0.0;  ///< that the joints need to the view planned next
  double render_ms = 0.0;
  double insert_ms = 0.0;  ///< into the map
  double grid_ms = 0.0;    ///< of voxels, which planning works on
  double plan_ms = 0.0;
};

/// What an episode comes to.
struct EpisodeSummary {
  double duration_s = 0.0;  ///< of the trajectory
  std::uint64_t captures = 0;
  std::uint64_t voxels = 0;
  double information = 0.0;
  std::optional<std::uint64_t> ghosts = {};  ///< as of the last capture
  InformationGrowth growth = {};
  PredictionRecord prediction;
  HazardTable hazards = HazardTable();                  ///< learnt, where the gain is expected
  std::optional<LocalisationRecord> localisation = {};  ///< none where poses are known
  std::optional<MapScore> map_score = {};               ///< none where it was not asked for
};

/// Runs an episode and grows the map, which the caller keeps whatever happens. Calls `observe`
/// after each capture; what it throws ends the episode. Without computing time charged, the same
/// arguments give the same map and captures, times in ms aside, for any number of threads; where
/// people are when depends on trajectory and seed alone, so that all modes meet the same. Throws
/// InputError as EpisodeOptions::validate() does, when slam has nothing to go by where the drive
/// starts, and when somebody has no floor below or stands in a wall at first; the map is then
/// untouched.
EpisodeSummary run_episode(const Scene& scene, const Trajectory& trajectory, const CameraMode& mode,
                           const EpisodeOptions& options, UncertaintyMap& map,
                           const std::function<void(const Capture&)>& observe);

}  // namespace nbvopt
