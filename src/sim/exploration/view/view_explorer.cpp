#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/field_check.hpp"
#include "nbvopt/sim/camera_mode.hpp"
#include "nbvopt/sim/view_exploration.hpp"
#include "sim/base_course.hpp"
#include "sim/episode_run.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/grid_planner.hpp"
#include "sim/exploration/plane_robot.hpp"
#include "sim/exploration/view/place_gains.hpp"
#include "sim/exploration/view/places.hpp"
#include "sim/exploration/view/promises.hpp"
#include "sim/exploration/view/travel_time.hpp"
#include "sim/exploration/view/way_information.hpp"

namespace nbvopt {
namespace {

/// How long a way is followed before others are weighed against it.
constexpr double kWeighAgain_s = 2.0;

/// Drives a base to where an episode has most to learn.
class ViewExplorer final : public BaseCourse {
 public:
  ViewExplorer(const Scene& scene, const Transform& T_map_base,
               const ViewExplorationOptions& options)
      : base_(options.drive.base),
        information_min_per_s_(options.information_min_per_s),
        look_s_(views_around(options.episode.robot.sensor) * options.episode.motion_time_s),
        region_(options.drive),
        robot_(scene, T_map_base, options.drive),
        costs_(robot_.drive_costs(/*through_unknown=*/false)),
        gains_(options.episode.robot, options.resolution_m),
        promises_(look_s_) {}

  void settle(double time_s, const EpisodeKnowledge& known) override {
    // The camera's map stays as it is meanwhile: one look at it is enough unless the way is barred.
    bool has_weighed = false;
    while (!status_ && robot_.time_s() < time_s) {
      if (robot_.is_out_of_time()) return end(ExplorationStatus::time_limit);
      if (robot_.is_path_blocked(costs_) || (!has_weighed && is_time_to_weigh())) {
        choose_way(known);
        has_weighed = true;
      }
      if (!status_) robot_.drive_to_next_scan();
    }
  }

  const Trajectory& trajectory() const override { return robot_.trajectory(); }

  Exploration exploration() const {
    return {status_.value_or(ExplorationStatus::time_limit), robot_.trajectory(), robot_.grid()};
  }

 private:
  bool is_time_to_weigh() const { return robot_.time_s() >= weigh_s_ || robot_.has_arrived(); }

  void choose_way(const EpisodeKnowledge& known) {
    GridPlanner planner(costs_, robot_.position_map_m(), robot_.grid().bounds());
    const std::vector<Place> places = reachable_places(costs_, planner, region_);
    gains_.update(places, known, robot_.trajectory());
    judge_promises(places, known);
    std::vector<Path> ways = worthwhile_ways(places, planner);
    const std::vector<double> information = information_along(ways, by_square(places), promises_);
    Path* best = nullptr;
    double most_per_s = information_min_per_s_;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const double time_s = travel_time_s(base_, robot_.yaw_rad(), ways[i]) + look_s_;
      const double per_s = information[i] / time_s;
      if (per_s < most_per_s) continue;
      most_per_s = per_s;
      best = &ways[i];
    }
    if (!best) return end(ExplorationStatus::complete);
    promises_.promise(most_per_s);
    weigh_s_ = robot_.time_s() + kWeighAgain_s;
    robot_.follow(std::move(*best));
  }

  /// To the places where there is enough for the look around alone.
  std::vector<Path> worthwhile_ways(const std::vector<Place>& places, GridPlanner& planner) const {
    std::vector<Path> ways;
    for (const Place& place : places) {
      if (promises_.believed(gains_.of(place)) < information_min_per_s_ * look_s_) continue;
      if (std::optional<Path> way = planner.path(place.position_map_m)) {
        ways.push_back(std::move(*way));
      }
    }
    return ways;
  }

  CellArray<const PlaceGain*> by_square(const std::vector<Place>& places) const {
    Eigen::AlignedBox2i box;
    for (const Place& place : places) box.extend(place.square);
    CellArray<const PlaceGain*> gains(nullptr, /*margin=*/0);
    if (!box.isEmpty()) gains.reserve(box);
    for (const Place& place : places) gains[place.square] = &gains_.of(place);
    return gains;
  }

  /// Where promises were broken, what is promised from here is not believed again.
  void judge_promises(const std::vector<Place>& places, const EpisodeKnowledge& known) {
    if (!promises_.is_broken(robot_.time_s(), known.information)) return;
    const Cell square = square_at(robot_.position_map_m());
    for (const Place& place : places) {
      if (place.square == square) promises_.doubt(gains_.of(place));
    }
  }

  void end(ExplorationStatus status) {
    status_ = status;
    robot_.stop();
  }

  BaseOptions base_;
  double information_min_per_s_;
  double look_s_;  ///< what looking all around takes
  DriveRegion region_;
  PlaneRobot robot_;
  DriveCosts costs_;
  PlaceGains gains_;
  Promises promises_;
  double weigh_s_ = 0.0;                     ///< when ways are weighed again
  std::optional<ExplorationStatus> status_;  ///< once it has ended
};

}  // namespace

void ViewExplorationOptions::validate() const {
  episode.validate();
  check_field(information_min_per_s > 0.0, "information_min_per_s", information_min_per_s,
              "positive and finite");
}

ViewExploration explore_views(const Scene& scene, const Transform& T_map_base,
                              const ViewExplorationOptions& options,
                              const std::function<void(const Capture&)>& observe) {
  options.validate();
  ViewExplorer explorer(scene, T_map_base, options);
  EpisodeOptions episode = options.episode;
  episode.charge_computing = false;
  episode.localisation.source = PoseSource::truth;
  episode.scores_map = false;
  UncertaintyMap map(options.resolution_m);
  const std::unique_ptr<const CameraMode> mode = make_camera_mode("auto");
  EpisodeSummary summary = run_episode_along(scene, explorer, *mode, episode, map, observe);
  return {explorer.exploration(), std::move(map), std::move(summary)};
}

}  // namespace nbvopt
