// A part of the map seen from above: where it lies on the page, and what all such pictures draw.
#pragma once

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "plot/canvas.hpp"

namespace nbvopt {

/// The part of the map that fills a panel.
struct TopView {
  Rectangle panel;
  Eigen::Vector2d min_m;
  double points_per_metre;

  Eigen::Vector2d max_m() const {
    return min_m + Eigen::Vector2d(panel.width, panel.height) / points_per_metre;
  }
  Eigen::Vector2d to_page(const Eigen::Vector2d& p_map_m) const {
    const Eigen::Vector2d offset = points_per_metre * (p_map_m - min_m);
    return {panel.x + offset.x(), panel.bottom() - offset.y()};
  }
};

/// The heights that a top view shows, in the map frame: a column is occupied when any voxel
/// between them is. Otherwise it is what it is at the camera's height.
struct MapSlice {
  double z_min_m = 0.0;
  double z_camera_m = 0.0;
  double z_max_m = 0.0;
};

/// From above the voxels of the ground under a base to just above its highest camera.
MapSlice map_slice(const Lattice& lattice, double z_base_m, double z_camera_m,
                   double highest_camera_m);

/// Columns of voxels: occupied ones by their mean uncertainty, free and unknown ones.
void draw_voxels(Canvas& canvas, const TopView& view, const VoxelGrid& grid, const MapSlice& slice);

/// An arrow head along the base's x axis.
void draw_robot(Canvas& canvas, const TopView& view, const Transform& T_map_base, Colour colour);

void draw_scale_bar(Canvas& canvas, const TopView& view);

/// The panel's frame with the axes below and to the left.
void draw_axes(Canvas& canvas, const TopView& view);

/// The colours of occupied voxels by uncertainty, with their meaning; `at` is the left end of the
/// ramp's baseline.
void draw_uncertainty_ramp(Canvas& canvas, const Eigen::Vector2d& at);

}  // namespace nbvopt
