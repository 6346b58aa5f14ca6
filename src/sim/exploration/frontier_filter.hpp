// The frontiers worth going to.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "nbvopt/sim/occupancy_grid.hpp"

namespace nbvopt {

/// A point where free space ends in the unknown.
struct Frontier {
  Eigen::Vector2d position_map_m;
  double unknown_m2;  ///< what is unknown around it, as unknown_area_m2() counts
};

/// How far around a frontier the unknown counts.
inline constexpr double kInformationRadius_m = 1.0;

/// The unknown area around a free point: cells within kInformationRadius_m that are connected to it
/// without passing an occupied one, so that what lies behind a wall does not count.
double unknown_area_m2(const OccupancyGrid& grid, const Eigen::Vector2d& position_map_m);

/// Whether enough is unknown around a free point to be worth a way.
bool is_worth_a_way(double unknown_m2);

/// Keeps few frontiers of the many that trees find. Umari and Mukhopadhyay cluster points to their
/// means; a mean may lie in a wall, so that here the first point found stands for its
/// neighbourhood.
class FrontierFilter {
 public:
  const std::vector<Frontier>& frontiers() const { return frontiers_; }

  /// Takes the points that are worth it, not yet stood for and not given up.
  void add(const OccupancyGrid& grid, std::span<const Eigen::Vector2d> points_map_m);

  /// Counts anew what is unknown, and drops the frontiers where little is left.
  void update(const OccupancyGrid& grid);

  /// Drops a frontier and refuses its neighbourhood: the robot came and saw nothing new.
  void give_up(const Eigen::Vector2d& position_map_m);

  /// As give_up(), for a frontier that cannot be reached yet.
  void set_aside(const Eigen::Vector2d& position_map_m);

  /// Refuses what was set aside no longer.
  void forget_aside() { aside_map_m_.clear(); }

 private:
  void drop(const Eigen::Vector2d& position_map_m);

  std::vector<Frontier> frontiers_;
  std::vector<Eigen::Vector2d> given_up_map_m_;
  std::vector<Eigen::Vector2d> aside_map_m_;
};

}  // namespace nbvopt
