#include "nbvopt/sim/episode.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "sim/base_course.hpp"
#include "sim/episode_run.hpp"
#include "sim/localisation/localiser.hpp"
#include "sim/people/bystanders.hpp"
#include "sim/people/ghosts.hpp"
#include "sim/realised_gain.hpp"

namespace nbvopt {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kTimeTolerance_s = 1e-9;

/// Runs the work and adds the milliseconds that it took.
template <class Work>
auto timed(double& sum_ms, const Work& work) {
  struct Stopwatch {
    double& sum_ms;
    Clock::time_point start = Clock::now();
    ~Stopwatch() {
      sum_ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }
  } stopwatch{sum_ms};
  return work();
}

void check_positive(const std::string& what, double value, const std::string& unit) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InputError(what + " is " + format_number(value) + ' ' + unit +
                   ", it must be greater than 0 and finite");
}

/// The joints of a camera that moves from one view to the next.
struct JointMove {
  JointPosition from;
  JointPosition to;
  double departure_s = 0.0;
};

/// The state of an episode between captures.
class EpisodeRun {
 public:
  EpisodeRun(const Scene& scene, BaseCourse& course, const CameraMode& mode,
             const EpisodeOptions& options, UncertaintyMap& map,
             const std::function<void(const Capture&)>& observe)
      : course_(course),
        mode_(mode),
        options_(options),
        map_(map),
        observe_(observe),
        mast_(options.robot.mast),
        planning_camera_(options.robot.sensor),
        scene_(scene),
        bystanders_(bystanders_of(scene, options.people, options.seed)),
        camera_(scene, options.robot.sensor, options.range_noise_m, options.seed,
                bystanders_ ? &bystanders_->bodies() : nullptr),
        localiser_(scene, course.trajectory(), options.localisation, options.seed) {
    std::vector<std::string> warnings;
    move_.from = move_.to = mast_.clamped(options.start_joints, warnings);
    const MapCounts counts = map.counts();
    summary_.voxels = counts.certain_voxels;
    summary_.information = counts.information;
    if (bystanders_) ghosts_.emplace(scene, map);
    if (mode.plans()) grid_ = VoxelGrid::whole(map);
    if (options.scores_map && errs()) map_of_true_poses_.emplace(map.resolution_m());
    summary_.hazards = options.hazards.value_or(
        HazardTable(course.trajectory().T_map_base(0.0).translation().z()));
  }

  /// The loop of Fig. 4: capture, insert, plan, move, capture.
  EpisodeSummary run() {
    double time_s = 0.0;
    for (std::uint64_t cycle = 1; time_s <= settled_s(); ++cycle) {
      const double computing_s = 1e-3 * look_and_plan(time_s);
      // Multiples of t, since the errors of a sum would grow.
      const double next_s = options_.charge_computing
                                ? time_s + computing_s + options_.motion_time_s
                                : static_cast<double>(cycle) * options_.motion_time_s;
      capture_on_the_way(time_s, next_s);
      time_s = next_s;
    }
    summary_.duration_s = settled_s();
    if (errs()) summary_.localisation = localiser_.record();
    if (options_.scores_map) {
      summary_.map_score = score_map(map_, errs() ? *map_of_true_poses_ : map_, scene_);
    }
    return summary_;
  }

 private:
  double settled_s() const { return course_.trajectory().duration_s(); }

  /// Captures where the camera has been planned to look, and sets it in motion to the next view.
  /// Returns the computing time.
  double look_and_plan(double time_s) {
    Capture capture = begin_capture(time_s, false);
    // The first view was nobody's choice.
    capture.predicted_gain = predicted_gain_;
    if (std::isfinite(predicted_gain_)) {
      capture.realised_gain = true_gain({capture.T_map_base, capture.T_world_base}, capture.joints);
      summary_.prediction.add(capture.predicted_gain, capture.realised_gain);
    }
    insert(capture);
    const double next_s = time_s + options_.motion_time_s;
    course_.settle(next_s, {grid_, summary_.hazards, summary_.information});
    const NextView next = plan(capture, next_s);
    const double computing_ms = capture.insert_ms + capture.grid_ms + capture.plan_ms;
    const double departure_s = options_.charge_computing ? time_s + 1e-3 * computing_ms : time_s;
    move_ = {capture.joints, next.joints, departure_s};
    predicted_gain_ = next.predicted_gain;
    capture.motion_time_s = mast_.move_time_s(capture.joints, next.joints);
    observe_(capture);
    return computing_ms;
  }

  /// Captures at the extra rate between two planned views.
  void capture_on_the_way(double begin_s, double end_s) {
    if (!options_.capture_hz) return;
    for (int i = 1;; ++i) {
      const double time_s = begin_s + i / *options_.capture_hz;
      // A capture that rounding puts just before the next view is that view's.
      if (time_s >= end_s - kTimeTolerance_s || time_s > settled_s()) return;
      Capture capture = begin_capture(time_s, true);
      insert(capture);
      observe_(capture);
    }
  }

  Capture begin_capture(double time_s, bool is_on_the_way) {
    Capture capture;
    capture.frame = summary_.captures++;
    capture.time_s = time_s;
    const BasePoses base = localiser_.at(time_s);
    capture.T_map_base = base.T_map_base;
    capture.T_world_base = base.T_world_base;
    capture.joints = is_on_the_way ? mast_.on_the_way(move_.from, move_.to,
                                                      std::max(0.0, time_s - move_.departure_s))
                                   : move_.to;
    capture.is_on_the_way = is_on_the_way;
    if (bystanders_) bystanders_->move_to(time_s, robot_map_m_);
    return capture;
  }

  PlanRequest request(const Capture& capture) const {
    PlanRequest request;
    request.T_map_base = capture.T_map_base;
    request.joints = capture.joints;
    request.motion_time_s = options_.motion_time_s;
    request.seed = options_.seed + capture.frame;
    return request;
  }

  /// The camera on a base, in the frame in which the base is given.
  Transform T_sensor_on(const Transform& T_base, const JointPosition& joints) const {
    PlanRequest there;
    there.T_map_base = T_base;
    return T_map_sensor(there, mast_, joints);
  }

  /// Takes the frame and puts it into the map.
  void insert(Capture& capture) {
    const Transform T = T_sensor_on(capture.T_map_base, capture.joints);
    const Transform T_world_sensor = T_sensor_on(capture.T_world_base, capture.joints);
    const Scan scan =
        timed(capture.render_ms, [&] { return camera_.capture(T_world_sensor, capture.frame); });
    if (grid_ && is_expected()) {
      timed(capture.insert_ms,
            [&] { learn_hazards(*grid_, scan, T, options_.robot.sensor, summary_.hazards); });
    }
    const InsertResult inserted =
        timed(capture.insert_ms, [&] { return insert_scan(map_, scan, T, options_.robot.sensor); });
    if (map_of_true_poses_) {
      insert_scan(*map_of_true_poses_, scan, T_world_sensor, options_.robot.sensor);
    }
    if (grid_) {
      timed(capture.grid_ms, [&] { grid_ = grid_->updated(inserted.changes); });
    }
    summary_.voxels += static_cast<std::uint64_t>(inserted.certain_voxels_gained);
    summary_.information += inserted.information_gained;
    capture.points_used = inserted.points_used;
    capture.voxels = summary_.voxels;
    capture.information = summary_.information;
    capture.information_gain = inserted.information_gained;
    if (ghosts_) {
      ghosts_->update(inserted.changes);
      summary_.ghosts = capture.ghosts = ghosts_->ghosts();
    }
    summary_.growth.add(capture.time_s, capture.information);
  }

  /// Plans the view of the capture that follows, at `next_s`. An expected gain is worth knowing
  /// where the base will be then; Eq. 12 does worse with it than with a base that stays.
  NextView plan(Capture& capture, double next_s) const {
    if (!grid_) return {.joints = capture.joints};
    const PlanRequest now = request(capture);
    PlanRequest next = now;
    const BasePoses ahead = localiser_.ahead(next_s);
    next.T_map_base = ahead.T_map_base;
    return timed(capture.plan_ms, [&] {
      return mode_.next_view(ViewPlanner(grid_, options_.robot, summary_.hazards),
                             is_expected() ? next : now,
                             [&](const JointPosition& joints) { return true_gain(ahead, joints); });
    });
  }

  /// What a view from there would realise on the map as it is.
  double true_gain(const BasePoses& base, const JointPosition& joints) const {
    return realised_gain(map_, planning_camera_,
                         camera_.planning_distances_m(T_sensor_on(base.T_world_base, joints)),
                         T_sensor_on(base.T_map_base, joints));
  }

  /// Whether the base may be elsewhere than it believes.
  bool errs() const { return options_.localisation.source != PoseSource::truth; }

  bool is_expected() const { return options_.robot.sensor.gain.has(GainKind::expected); }

  BaseCourse& course_;
  const CameraMode& mode_;
  const EpisodeOptions& options_;
  UncertaintyMap& map_;
  const std::function<void(const Capture&)>& observe_;
  Mast mast_;
  DepthCamera planning_camera_;
  const Scene& scene_;
  std::optional<Bystanders> bystanders_;
  RobotPosition robot_map_m_ = [this](double time_s) {
    return Eigen::Vector3d(course_.trajectory().T_map_base(time_s).translation());
  };
  SimulatedCamera camera_;
  std::optional<GhostCounter> ghosts_;
  Localiser localiser_;
  std::optional<UncertaintyMap> map_of_true_poses_;  ///< of the same views, to score the map by
  std::shared_ptr<const VoxelGrid> grid_;  ///< of the map; null where the mode does not plan
  JointMove move_;                         ///< the latest
  double predicted_gain_ = Capture::kNaN;  ///< of the view that the camera moves to
  EpisodeSummary summary_;
};

}  // namespace

void EpisodeOptions::validate() const {
  check_positive("the motion time of an episode", motion_time_s, "s");
  if (capture_hz) check_positive("the capture rate", *capture_hz, "Hz");
  check_range_noise(range_noise_m);
  localisation.validate();
  robot.sensor.validate();
  std::vector<std::string> warnings;
  Mast(robot.mast).clamped(start_joints, warnings);
}

EpisodeSummary run_episode(const Scene& scene, const Trajectory& trajectory, const CameraMode& mode,
                           const EpisodeOptions& options, UncertaintyMap& map,
                           const std::function<void(const Capture&)>& observe) {
  RecordedCourse course(trajectory);
  return run_episode_along(scene, course, mode, options, map, observe);
}

EpisodeSummary run_episode_along(const Scene& scene, BaseCourse& course, const CameraMode& mode,
                                 const EpisodeOptions& options, UncertaintyMap& map,
                                 const std::function<void(const Capture&)>& observe) {
  options.validate();
  return EpisodeRun(scene, course, mode, options, map, observe).run();
}

}  // namespace nbvopt
