// Where a scan fits into a map.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/odometry/planar_pose.hpp"
#include "sim/slam/tile_grid.hpp"

namespace nbvopt {

/// The mean hits of a grid's occupied cells around a place, laid out for fast looking up.
class HitField {
 public:
  /// Of the cells that points within reach_m of a place may lie in, and those beside them.
  HitField(const TileGrid& grid, const Eigen::Vector2d& centre_map_m, double reach_m);

  /// The squared distances, cells^2, of points from the nearest mean hit of the 3 x 3 cells around
  /// each; kNone where there is none. Points are hits in the frame of a base at that pose.
  void squared_distances(const PlanarPose& T_map_base, std::span<const Eigen::Vector2f> hits_base_m,
                         Eigen::ArrayXf& squared_cells2) const;

  static constexpr float kNone = 1e8F;  ///< cells^2

 private:
  double cell_m_;
  Cell min_;
  int width_;
  int height_;
  std::vector<Eigen::Vector2f> mean_hits_;  ///< from min_, in cells, row by row; far off where none
};

/// A place where a scan fits, and how well.
struct ScanMatch {
  PlanarPose T_map_base;
  double score = 0.0;           ///< about how many hits met one of the grid
  double log_likelihood = 0.0;  ///< of the scan there
};

/// Climbs from a guess to where the hits of a scan meet those of the grid best: GMapping's search
/// by steps of 0.05 m and 0.05 rad to all sides, halved five times, with every beam. The score is
/// the sum of exp(-d^2 / 2 sigma^2) over the hits, d the distance from the nearest mean hit of the
/// 3 x 3 cells around, sigma 0.05 m (GMapping leaves the 2 out and divides by sigma once, which is
/// flat where it should be steep). The likelihood is GMapping's, with sigma 0.075. Where nothing
/// fits, the guess remains.
ScanMatch match_scan(const TileGrid& grid, std::span<const Eigen::Vector2f> hits_base_m,
                     const PlanarPose& guess_T_map_base);

}  // namespace nbvopt
