// What is to be had at the places that a base can reach, kept from decision to decision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "nbvopt/sim/trajectory.hpp"
#include "sim/base_course.hpp"
#include "sim/exploration/view/place_panorama.hpp"
#include "sim/exploration/view/places.hpp"

namespace nbvopt {

class PlaceGains {
 public:
  PlaceGains(const Robot& robot, double resolution_m);

  /// Looks around at those places, on the floor that the trajectory drives on, that are new or that
  /// the camera may have seen something of since: it has come as near as two of its ranges. On all
  /// cores.
  void update(std::span<const Place> places, const EpisodeKnowledge& known,
              const Trajectory& trajectory);

  /// Of a place that was among those of the last update. Cubes are named by numbers from 0 on.
  const PlaceGain& of(const Place& place) const { return gains_.at(place.square).gain; }

 private:
  struct Known {
    Eigen::Vector2d position_map_m;
    std::size_t points;  ///< of the trajectory that this takes account of
    PlaceGain gain;
  };

  /// Looks at the points of the trajectory that are new since it was asked last.
  bool is_up_to_date(const Place& place, const Trajectory& trajectory);

  PlacePanorama panorama_;
  double reach_m_;
  std::unordered_map<std::uint64_t, std::uint64_t> numbers_;  ///< of the panorama's cubes
  std::map<Cell, Known, SquareOrder> gains_;
};

}  // namespace nbvopt
