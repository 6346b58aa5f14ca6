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
#include "sim/exploration/view/way.hpp"

namespace nbvopt {
namespace {

/// How long a way is followed before others are weighed against it.
constexpr double kWeighAgain_s = 2.0;

/// What is believed of every place in reach.
using Believed = std::map<Cell, PlaceGain, SquareOrder>;

double total(const PlaceGain& gain) {
  double information = 0.0;
  for (const CubeGain& part : gain) information += part.information;
  return information;
}

/// The places that a path comes by.
std::vector<const PlaceGain*> places_along(const Path& path, const Believed& believed) {
  constexpr double kStep_m = 0.25;
  std::vector<const PlaceGain*> passed;
  for (double along_m = 0.0;; along_m += kStep_m) {
    const auto place = believed.find(square_at(path.point_at(along_m)));
    if (place != believed.end() && (passed.empty() || passed.back() != &place->second)) {
      passed.push_back(&place->second);
    }
    if (along_m >= path.length_m()) return passed;
  }
}

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
    Believed believed;
    for (const Place& place : places) {
      believed.emplace(place.square, promises_.believed(gains_.of(place)));
    }
    std::optional<Way> best;
    double most_per_s = information_min_per_s_;
    for (const Place& place : places) {
      std::optional<Way> way = way_to(place, planner, believed);
      if (!way) continue;
      const double per_s = information_per_s(*way, look_s_);
      if (per_s < most_per_s) continue;
      most_per_s = per_s;
      best = std::move(way);
    }
    if (!best) return end(ExplorationStatus::complete);
    promises_.promise(most_per_s);
    weigh_s_ = robot_.time_s() + kWeighAgain_s;
    robot_.follow(std::move(best->path));
  }

  /// None to where nothing is worth even the look around.
  std::optional<Way> way_to(const Place& place, GridPlanner& planner,
                            const Believed& believed) const {
    if (total(believed.at(place.square)) < information_min_per_s_ * look_s_) return std::nullopt;
    std::optional<Path> path = planner.path(place.position_map_m);
    if (!path) return std::nullopt;
    const double travel_s = travel_time_s(base_, robot_.yaw_rad(), *path);
    std::vector<const PlaceGain*> passed = places_along(*path, believed);
    return Way{std::move(*path), travel_s, std::move(passed)};
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
