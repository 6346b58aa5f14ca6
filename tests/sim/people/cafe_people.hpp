// The people of Gazebo's cafe.
#pragma once

#include "nbvopt/sim/people.hpp"

namespace nbvopt::test {

/// As cafe.world has them.
inline People cafe_people() {
  const auto walker = [](const char* name, const Eigen::Vector3d& from,
                         const Eigen::Vector3d& target) {
    return Person{.name = name,
                  .position_map_m = from,
                  .walk = TargetWalk{.target_map_m = target,
                                     .target_weight = 1.15,
                                     .obstacle_weight = 1.8,
                                     .ignored_models = {"cafe", "ground_plane"}}};
  };
  return {.persons = {walker("actor1", {0.0, 1.0, 1.25}, {0.0, -5.0, 1.2138}),
                      walker("actor2", {-2.0, -2.0, 1.25}, {3.0, 2.0, 1.24})},
          .models = {{"ground_plane", {0.0, 0.0, 0.0}},
                     {"cafe", {0.0, 0.0, 0.0}},
                     {"table1", {0.5, -1.6, 0.2}},
                     {"table2", {2.4, -5.5, 0.2}},
                     {"table3", {-1.5, -5.5, 0.2}},
                     {"table4", {2.4, -9.0, 0.2}},
                     {"table5", {-1.5, -9.0, 0.2}}}};
}

}  // namespace nbvopt::test
