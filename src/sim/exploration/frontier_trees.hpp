// Trees that grow over free space and find where it ends in the unknown.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "nbvopt/sim/occupancy_grid.hpp"

namespace nbvopt {

/// A rapidly-exploring random tree over the free cells of a grid. Nothing asks for its edges, so
/// that it keeps its nodes only.
class RapidTree {
 public:
  explicit RapidTree(const Eigen::Vector2d& root_map_m);
  ~RapidTree();
  RapidTree(RapidTree&&) noexcept;
  RapidTree& operator=(RapidTree&&) noexcept;

  /// Grows an edge, at most `edge_m` long, from the node nearest to the sample towards it. The edge
  /// becomes part of the tree when all its cells are free. When it meets an unknown cell before an
  /// occupied one, returns its last free point: a frontier.
  std::optional<Eigen::Vector2d> grow(const OccupancyGrid& grid,
                                      const Eigen::Vector2d& sample_map_m, double edge_m);

 private:
  struct Nodes;
  std::unique_ptr<Nodes> nodes_;
};

/// The two detectors of Umari and Mukhopadhyay: a global tree, rooted at the start, that grows for
/// ever and reaches every corner in the end; and a local one, rooted at the robot, that starts anew
/// whenever it has found a frontier, and so finds near ones fast.
class FrontierTrees {
 public:
  FrontierTrees(const Eigen::Vector2d& start_map_m, std::uint64_t seed);

  /// Grows both trees by a fixed number of samples; returns the frontier points met.
  std::vector<Eigen::Vector2d> grow(const OccupancyGrid& grid, const Eigen::Vector2d& robot_map_m);

 private:
  Eigen::Vector2d sample(const OccupancyGrid& grid);

  RapidTree global_;
  RapidTree local_;
  std::mt19937_64 random_;
};

}  // namespace nbvopt
