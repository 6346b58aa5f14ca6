#include "cli/plot_map.hpp"

#include <algorithm>
#include <cmath>

#include "cli/plot_axis.hpp"
#include "cli/plot_style.hpp"
#include "nbvopt/map/colour_ramp.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

constexpr int kTicks = 9;  ///< an axis, about

/// The square of the map that is shown, and where it lies on the page.
struct TopView {
  Rectangle panel;
  Eigen::Vector2d min_m;
  double side_m;

  Eigen::Vector2d to_page(const Eigen::Vector2d& p_map_m) const {
    const Eigen::Vector2d share = (p_map_m - min_m) / side_m;
    return {panel.x + share.x() * panel.width, panel.bottom() - share.y() * panel.height};
  }
  double points_per_metre() const { return panel.width / side_m; }
};

TopView top_view(const Rectangle& panel, const PlotInput& input) {
  constexpr double kMargin_m = 0.5;
  const double reach_m = input.robot.sensor.range_max_m + kMargin_m;
  const Eigen::Vector2d centre_m = input.request.T_map_base.translation().head<2>();
  return {panel, centre_m - Eigen::Vector2d::Constant(reach_m), 2.0 * reach_m};
}

Colour occupied_colour(const VoxelGrid& grid, double uncertainty) {
  if (!grid.carries_uncertainty()) return style::kOccupied;
  const auto [red, green, blue] = uncertainty_colour(uncertainty);
  return {red / 255.0, green / 255.0, blue / 255.0};
}

/// A column's colour: the mean uncertainty of its occupied voxels, or its state at the camera.
Colour column_colour(const VoxelGrid& grid, VoxelKey column, std::uint16_t z_min,
                     std::uint16_t z_camera, std::uint16_t z_max) {
  double uncertainty = 0.0;
  int occupied = 0;
  for (std::uint32_t z = z_min; z <= z_max; ++z) {
    const VoxelKey key{column.x, column.y, static_cast<std::uint16_t>(z)};
    if (grid.state(key) != VoxelState::occupied) continue;
    uncertainty += grid.uncertainty(key);
    ++occupied;
  }
  if (occupied > 0) return occupied_colour(grid, uncertainty / occupied);
  const bool is_free = grid.state({column.x, column.y, z_camera}) == VoxelState::free;
  return is_free ? style::kFree : style::kUnknown;
}

void draw_voxels(Canvas& canvas, const TopView& view, const VoxelGrid& grid,
                 const MapSlice& slice) {
  // More cells than pixels would cost time and show nothing.
  constexpr int kMaxCells = 1200;
  const Lattice& lattice = grid.lattice();
  const Eigen::Vector2d max_m = view.min_m + Eigen::Vector2d::Constant(view.side_m);
  const VoxelKey min = lattice.key({view.min_m.x(), view.min_m.y(), slice.z_min_m});
  const VoxelKey max = lattice.key({max_m.x(), max_m.y(), slice.z_max_m});
  const std::uint16_t z_camera = lattice.key({0.0, 0.0, slice.z_camera_m}).z;
  grid.make_ready(
      {{min.x, min.y, std::min(min.z, z_camera)}, {max.x, max.y, std::max(max.z, z_camera)}});

  const int stride = 1 + std::max(max.x - min.x, max.y - min.y) / kMaxCells;
  Raster raster{(max.x - min.x) / stride + 1, (max.y - min.y) / stride + 1, {}};
  for (int row = raster.rows - 1; row >= 0; --row) {
    for (int column = 0; column < raster.columns; ++column) {
      const VoxelKey key{static_cast<std::uint16_t>(min.x + column * stride),
                         static_cast<std::uint16_t>(min.y + row * stride), 0};
      raster.cells.push_back(column_colour(grid, key, min.z, z_camera, max.z));
    }
  }
  const double cell = stride * lattice.resolution_m() * view.points_per_metre();
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * lattice.resolution_m());
  const Eigen::Vector2d lower_left = view.to_page(lattice.centre_m(min).head<2>() - half);
  const double height = raster.rows * cell;
  canvas.draw(raster, {lower_left.x(), lower_left.y() - height, raster.columns * cell, height});
}

/// The field of view from above: the image's middle row from D_min to D_max, walls or not.
Polygon view_cone(const TopView& view, SensorOptions sensor, const Transform& T_map_sensor) {
  constexpr int kRays = 96;
  sensor.ray_pattern = RayPattern::pixel_centres;  // one row has no edges to run between
  const CameraRays rays = make_rays(sensor, kRays, 1);
  Polygon cone;
  const auto add = [&](std::size_t i, double range_m) {
    const Eigen::Vector3d p_map_m = T_map_sensor * (range_m * rays.direction(i));
    cone.push_back(view.to_page(p_map_m.head<2>()));
  };
  for (std::size_t i = 0; i < rays.size(); ++i) add(i, rays.range_min_m[i]);
  for (std::size_t i = rays.size(); i-- > 0;) add(i, rays.range_max_m[i]);
  return cone;
}

void draw_views(Canvas& canvas, const TopView& view, const PlotInput& input) {
  const Mast mast(input.robot.mast);
  const Polygon current =
      view_cone(view, input.robot.sensor, T_map_sensor(input.request, mast, input.request.joints));
  const Polygon chosen = view_cone(view, input.robot.sensor, input.result.T_map_sensor);
  canvas.fill(chosen, style::kChosen.with_alpha(0.16));
  canvas.stroke_closed(chosen, {style::kPaper.with_alpha(0.8), 4.0});
  canvas.stroke_closed(chosen, style::chosen_stroke());
  canvas.stroke_closed(current, {style::kPaper.with_alpha(0.8), 3.5});
  canvas.stroke_closed(current, style::current_stroke());
}

/// An arrow head along the base's x axis.
void draw_robot(Canvas& canvas, const TopView& view, const Transform& T_map_base, Colour colour) {
  const Eigen::Vector2d at = view.to_page(T_map_base.translation().head<2>());
  const Eigen::Vector3d x_map = T_map_base.linear().col(0);
  const Eigen::Vector2d forward = Eigen::Vector2d(x_map.x(), -x_map.y()).stableNormalized();
  const Eigen::Vector2d right(-forward.y(), forward.x());
  const Polygon arrow{at + 15.0 * forward, at - 10.0 * forward + 10.0 * right, at - 5.0 * forward,
                      at - 10.0 * forward - 10.0 * right};
  canvas.stroke_closed(arrow, {style::kPaper, 4.0});
  canvas.fill(arrow, colour);
}

void draw_scale_bar(Canvas& canvas, const TopView& view) {
  const Ticks ticks = make_ticks(0.0, view.side_m, kTicks);
  const double length_m = ticks.step;
  const double length = length_m * view.points_per_metre();
  const Eigen::Vector2d start(view.panel.x + 16.0, view.panel.bottom() - 16.0);
  canvas.fill(Rectangle{start.x() - 8.0, start.y() - 24.0, length + 16.0, 32.0},
              style::kPaper.with_alpha(0.85));
  const Polygon bar{start - Eigen::Vector2d(0.0, 5.0), start, start + Eigen::Vector2d(length, 0.0),
                    start + Eigen::Vector2d(length, -5.0)};
  canvas.stroke_open(bar, {style::kInk, 1.5});
  canvas.text(start + Eigen::Vector2d(0.5 * length, -6.0), ticks.label(length_m) + " m",
              style::body(Anchor::centre));
}

void draw_axes(Canvas& canvas, const TopView& view) {
  const auto& [panel, min_m, side_m] = view;
  canvas.stroke(panel, {style::kMutedInk, 1.0});
  draw_axis_below(
      canvas, panel, make_ticks(min_m.x(), min_m.x() + side_m, kTicks),
      [&](double x_m) {
        return view.to_page({x_m, view.min_m.y()}).x();
      },
      "map x (m)");
  draw_axis_left(
      canvas, panel, make_ticks(min_m.y(), min_m.y() + side_m, kTicks),
      [&](double y_m) {
        return view.to_page({view.min_m.x(), y_m}).y();
      },
      "map y (m)", 8.0, 36.0);
}

}  // namespace

MapSlice map_slice(const PlotInput& input) {
  constexpr double kAboveGround_m = 0.05;
  constexpr double kAboveMast_m = 0.3;
  const double z_base_m = input.request.T_map_base.translation().z();
  return {.z_min_m = z_base_m + kAboveGround_m,
          .z_camera_m = input.result.T_map_sensor.translation().z(),
          .z_max_m = z_base_m + input.robot.mast.height_max_m + kAboveMast_m};
}

void draw_map(Canvas& canvas, const Rectangle& panel, const PlotInput& input,
              const MapSlice& slice) {
  const TopView view = top_view(panel, input);
  canvas.clipped(panel, [&] {
    draw_voxels(canvas, view, input.grid, slice);
    draw_views(canvas, view, input);
    if (!input.request.base_twist.is_zero()) {
      draw_robot(canvas, view, input.result.T_map_base, style::kChosen);
    }
    draw_robot(canvas, view, input.request.T_map_base, style::kCurrent);
    draw_scale_bar(canvas, view);
  });
  draw_axes(canvas, view);
}

}  // namespace nbvopt
