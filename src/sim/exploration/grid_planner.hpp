// The cheapest ways over an occupancy grid.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "sim/exploration/drive_costs.hpp"
#include "sim/exploration/path.hpp"

namespace nbvopt {

/// Ways from one start to any goal: Dijkstra's search over the 8 neighbours of each cell, which
/// spreads only as far as it is asked and goes on from there.
class GridPlanner {
 public:
  /// Searches inside the box, which holds the start. The costs must not change meanwhile.
  GridPlanner(const DriveCosts& costs, const Eigen::Vector2d& start_map_m,
              const Eigen::AlignedBox2i& box);

  /// What the way to a cell costs; none where there is no way.
  std::optional<double> cost_m(const Cell& goal);

  /// The way to a goal, pulled straight wherever that costs no more; none where there is none.
  std::optional<Path> path(const Eigen::Vector2d& goal_map_m);

 private:
  enum class Passable : std::uint8_t { not_asked, no, yes };
  struct Node {
    float cost_m;
    std::int8_t came_by;  ///< the number of the step that leads here
    bool is_settled;
    Passable passable;
  };
  using Entry = std::pair<float, int>;  ///< cost and node: ties settle in the order of nodes

  int number(const Cell& cell) const;
  Cell cell(int number) const;
  Eigen::Vector2d point_map_m(int number) const;
  int before(int number) const;
  void spread(int from);
  bool is_passable(int number, const Cell& cell);
  void relax(int from, int step, const Cell& next);

  /// Where the last straight piece of the way to a node begins. Ways share what they begin with, so
  /// that each node of the tree that they make is pulled straight once.
  int corner_before(int number);

  /// The same for a point in the node's cell.
  int corner_before(int number, const Eigen::Vector2d& point_map_m);

  const DriveCosts& costs_;
  Eigen::Vector2d start_map_m_;
  Eigen::AlignedBox2i box_;
  int start_ = 0;
  std::vector<Node> nodes_;
  std::vector<int> corners_;  ///< corner_before() each node, once that is known; else kUnknown
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
};

}  // namespace nbvopt
