#include "sim/exploration/view/place_gains.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace nbvopt {

PlaceGains::PlaceGains(const Robot& robot, double resolution_m)
    : panorama_(robot, resolution_m), reach_m_(2.0 * robot.sensor.longest_range_m()) {}

void PlaceGains::update(std::span<const Place> places, const EpisodeKnowledge& known,
                        const Trajectory& trajectory) {
  std::vector<const Place*> changed;
  for (const Place& place : places) {
    if (!is_up_to_date(place, trajectory)) changed.push_back(&place);
  }
  std::vector<PlaceGain> found(changed.size());
  const double floor_map_m = trajectory.points().front().z_m;
  tbb::parallel_for(std::size_t{0}, changed.size(), [&](std::size_t i) {
    const Eigen::Vector2d& position = changed[i]->position_map_m;
    found[i] = panorama_.look_around(*known.grid, known.hazards,
                                     {position.x(), position.y(), floor_map_m});
  });
  for (std::size_t i = 0; i < changed.size(); ++i) {
    for (CubeGain& part : found[i]) {
      part.cube = numbers_.try_emplace(part.cube, numbers_.size()).first->second;
    }
    gains_.insert_or_assign(
        changed[i]->square,
        Known{changed[i]->position_map_m, trajectory.points().size(), std::move(found[i])});
  }
}

bool PlaceGains::is_up_to_date(const Place& place, const Trajectory& trajectory) {
  const auto known = gains_.find(place.square);
  if (known == gains_.end() || known->second.position_map_m != place.position_map_m) return false;
  // The last point of then is where the camera may have looked from since.
  const auto since = std::span(trajectory.points()).subspan(known->second.points - 1);
  known->second.points = trajectory.points().size();
  return std::ranges::none_of(since, [&](const TrajectoryPoint& point) {
    return (Eigen::Vector2d(point.x_m, point.y_m) - place.position_map_m).norm() < reach_m_;
  });
}

}  // namespace nbvopt
