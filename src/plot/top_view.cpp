#include "plot/top_view.hpp"

#include <algorithm>
#include <vector>

#include "nbvopt/map/colour_ramp.hpp"
#include "plot/axis.hpp"
#include "plot/style.hpp"

namespace nbvopt {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

constexpr int kTicks = 9;  ///< across the panel, about

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

}  // namespace

MapSlice map_slice(const Lattice& lattice, double z_base_m, double z_camera_m,
                   double highest_camera_m) {
  // The ground fills a voxel, or two where it lies on the face between them.
  const double above_ground_m = 1.5 * lattice.resolution_m();
  constexpr double kAboveMast_m = 0.3;
  return {.z_min_m = z_base_m + above_ground_m,
          .z_camera_m = z_camera_m,
          .z_max_m = z_base_m + highest_camera_m + kAboveMast_m};
}

void draw_voxels(Canvas& canvas, const TopView& view, const VoxelGrid& grid,
                 const MapSlice& slice) {
  // More cells than pixels would cost time and show nothing.
  constexpr int kMaxCells = 1200;
  const Lattice& lattice = grid.lattice();
  const Eigen::Vector2d max_m = view.max_m();
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
  const double cell = stride * lattice.resolution_m() * view.points_per_metre;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * lattice.resolution_m());
  const Eigen::Vector2d lower_left = view.to_page(lattice.centre_m(min).head<2>() - half);
  const double height = raster.rows * cell;
  canvas.draw(raster, {lower_left.x(), lower_left.y() - height, raster.columns * cell, height});
}

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
  const Ticks ticks = make_ticks(0.0, view.panel.width / view.points_per_metre, kTicks);
  const double length_m = ticks.step;
  const double length = length_m * view.points_per_metre;
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
  const Rectangle& panel = view.panel;
  const Eigen::Vector2d max_m = view.max_m();
  const double points_a_tick = panel.width / kTicks;
  const int rows = std::max(2, static_cast<int>(panel.height / points_a_tick));
  canvas.stroke(panel, {style::kMutedInk, 1.0});
  draw_axis_below(
      canvas, panel, make_ticks(view.min_m.x(), max_m.x(), kTicks),
      [&](double x_m) {
        return view.to_page({x_m, view.min_m.y()}).x();
      },
      "map x (m)");
  draw_axis_left(
      canvas, panel, make_ticks(view.min_m.y(), max_m.y(), rows),
      [&](double y_m) {
        return view.to_page({view.min_m.x(), y_m}).y();
      },
      "map y (m)", 8.0, 36.0);
}

void draw_uncertainty_ramp(Canvas& canvas, const Eigen::Vector2d& at) {
  constexpr int kSteps = 64;
  constexpr double kWidth = 194.0;
  Raster ramp{kSteps, 1, {}};
  for (int i = 0; i < kSteps; ++i) {
    const auto [red, green, blue] = uncertainty_colour(i / (kSteps - 1.0));
    ramp.cells.push_back({red / 255.0, green / 255.0, blue / 255.0});
  }
  canvas.draw(ramp, {at.x(), at.y() - 10.0, kWidth, 12.0});
  canvas.text({at.x(), at.y() + 15.0}, "0 well seen", style::note());
  canvas.text({at.x() + kWidth, at.y() + 15.0}, "1 not yet", style::note(Anchor::right));
  canvas.text({at.x() + kWidth + 8.0, at.y()}, "occupied, by uncertainty u", style::body());
}

}  // namespace nbvopt
