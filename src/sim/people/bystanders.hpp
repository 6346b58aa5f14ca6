// The people of a world as a simulation meets them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nbvopt/sim/people.hpp"
#include "nbvopt/sim/scene.hpp"
#include "sim/people/crowd.hpp"
#include "sim/people/people_scene.hpp"

namespace nbvopt {

/// People who walk through a scene, each on his floor.
class Bystanders {
 public:
  /// Throws InputError that names somebody below whom there is no floor, or who stands in or at a
  /// wall at first.
  Bystanders(const Scene& scene, const People& people, std::uint64_t seed);

  /// Moves everybody on to that time, as Crowd::walk_until() does.
  void move_to(double time_s, const RobotPosition& robot_map_m);

  /// As they stand.
  const PeopleScene& bodies() const { return bodies_; }

 private:
  Crowd crowd_;
  std::vector<double> feet_below_m_;  ///< of each walker's position
  PeopleScene bodies_;
};

/// None where nobody is. Throws as Bystanders does.
std::optional<Bystanders> bystanders_of(const Scene& scene, const People& people,
                                        std::uint64_t seed);

}  // namespace nbvopt
