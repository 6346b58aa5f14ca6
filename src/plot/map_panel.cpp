#include "plot/map_panel.hpp"

#include <vector>

#include "nbvopt/sensor/depth_camera.hpp"
#include "plot/style.hpp"

namespace nbvopt {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

TopView top_view(const Rectangle& panel, const PlotInput& input) {
  constexpr double kMargin_m = 0.5;
  const double reach_m = input.planner.robot().sensor.range_max_m + kMargin_m;
  const Eigen::Vector2d centre_m = input.result.request.T_map_base.translation().head<2>();
  return {panel, centre_m - Eigen::Vector2d::Constant(reach_m), 0.5 * panel.width / reach_m};
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
  const PlanRequest& request = input.result.request;
  const SensorOptions& sensor = input.planner.robot().sensor;
  const Polygon current =
      view_cone(view, sensor, T_map_sensor(request, input.planner.mast(), request.joints));
  const Polygon chosen = view_cone(view, sensor, input.result.T_map_sensor);
  canvas.fill(chosen, style::kChosen.with_alpha(0.16));
  canvas.stroke_closed(chosen, {style::kPaper.with_alpha(0.8), 4.0});
  canvas.stroke_closed(chosen, style::chosen_stroke());
  canvas.stroke_closed(current, {style::kPaper.with_alpha(0.8), 3.5});
  canvas.stroke_closed(current, style::current_stroke());
}

}  // namespace

MapSlice map_slice(const PlotInput& input) {
  return map_slice(
      input.planner.grid()->lattice(), input.result.request.T_map_base.translation().z(),
      input.result.T_map_sensor.translation().z(), input.planner.robot().mast.height_max_m);
}

void draw_map(Canvas& canvas, const Rectangle& panel, const PlotInput& input,
              const MapSlice& slice) {
  const TopView view = top_view(panel, input);
  canvas.clipped(panel, [&] {
    draw_voxels(canvas, view, *input.planner.grid(), slice);
    draw_views(canvas, view, input);
    if (!input.result.request.base_twist.is_zero()) {
      draw_robot(canvas, view, input.result.T_map_base, style::kChosen);
    }
    draw_robot(canvas, view, input.result.request.T_map_base, style::kCurrent);
    draw_scale_bar(canvas, view);
  });
  draw_axes(canvas, view);
}

}  // namespace nbvopt
