// The most that any ray of a cone can bring by what it hits: the rays from anywhere in a box of
// origins, in any direction of a cell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gain/cone_grid.hpp"
#include "gain/cone_span.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt::detail {

/// A cone by its slopes against the axis that it runs along most. Lengths in voxels, places from
/// the grid's corner, along the main axis from its other end where rays go down. Of origins the
/// place along the main axis comes first, then those along a layer's row axis and column axis.
struct Cone {
  int across = 0;
  bool goes_down = false;
  std::array<double, 3> origin_min{}, origin_max{};
  double row_slope_min = 0.0, row_slope_max = 0.0;        ///< per voxel along |across|
  double column_slope_min = 0.0, column_slope_max = 0.0;  ///< likewise
  double stretch_min = 1.0, stretch_max = 1.0;  ///< length of a ray per voxel along |across|
  double clear = 0.0;  ///< nothing nearer than this can be hit, nor stop a ray
};

/// What a cone met.
struct ConeView {
  /// No ray that the cone holds has a first hit with a larger u_old - weight * u_d (the angle's
  /// part of u_new is the ray's own); kNothing where there is none.
  double value = kNothing;
  double clear = 0.0;  ///< how far nothing can be hit, nor stop a ray, voxels; endless if nothing
  bool is_settled = false;  ///< narrower cones within it bring as much, or next to it

  static constexpr double kNothing = -1.0;
  static constexpr double kEndless = 1e30;
};

class ConeMarch {
 public:
  /// The grid must outlive it.
  ConeMarch(const ConeGrid& grid, const DepthCamera& camera, double resolution_m,
            bool carries_uncertainty);

  /// The cone's windows must lie in the grid's box.
  ConeView operator()(const Cone& cone) const;

 private:
  struct Layer;
  Layer layer_at(const Cone& cone, int k) const;
  /// How many layers from this one on lie, as far as the cone touches them, in the cube of free
  /// voxels around its middle.
  int free_layers(const Cone& cone, const Layer& layer) const;
  /// Widens the values of first hits by those in these voxels.
  void take_hits(const Cone& cone, const Layer& layer, std::uint64_t hits, std::uint64_t in_front,
                 ConeSpan& values) const;
  std::array<int, 3> place_of(const Cone& cone, const Layer& layer, int bit) const;
  /// Which of these voxels are occupied, and which of these free ones have unknown neighbours.
  std::uint64_t occupied_of(const Cone& cone, const Layer& layer, std::uint64_t voxels) const;
  std::uint64_t frontiers_of(const Cone& cone, const Layer& layer, std::uint64_t voxels) const;
  /// No more than the least, and no less than the largest u_d between two distances, times its
  /// weight.
  double least_distance_part(double from, double to) const;
  double largest_distance_part(double from, double to) const;

  const ConeGrid& grid_;
  double resolution_m_;
  double near_min_, near_max_, far_min_, far_;  ///< of all rays
  bool near_blocking_;
  bool sees_through_unknown_;  ///< the expected gain does
  double focal_;
  /// u_d times its weight, by the distance from the focal one in sixteenths of a voxel.
  std::vector<double> distance_part_;
  double unknown_value_;  ///< u_old of the unknown, less what normals take
  float none_stored_;     ///< u of occupied voxels in bricks that store none
};

}  // namespace nbvopt::detail
