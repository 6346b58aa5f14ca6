#include "plot/episode_plot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/number.hpp"
#include "plot/axis.hpp"
#include "plot/style.hpp"
#include "plot/top_view.hpp"

namespace nbvopt {
namespace {

constexpr double kPixelsPerPoint = 2.0;
constexpr double kPageWidth = 1000.0;
constexpr double kLeft = 72.0;
constexpr double kRight = 24.0;
constexpr double kTop = 84.0;
constexpr double kLegendHeight = 100.0;  ///< with the axis below the map
constexpr double kChartHeight = 150.0;
constexpr double kChartAxisHeight = 64.0;

std::string subtitle(const EpisodeReport& report) {
  return std::filesystem::path(report.world).filename().string() + ", mode " + report.mode +
         ", t = " + format_number(report.motion_time_s) +
         " s: " + std::to_string(report.summary.captures) + " captures, " +
         std::to_string(report.summary.voxels) + " voxels with u < 1, information " +
         std::to_string(std::llround(report.summary.information));
}

/// The known part of the map with a margin, so wide on the page, not higher than it is wide.
TopView top_view(const UncertaintyMap& map, const Eigen::Vector2d& top_left, double width) {
  constexpr double kMargin_m = 0.5;
  const KeyBox box = map.known_box().value_or(KeyBox{});
  const Eigen::Vector2d min_m =
      map.lattice().centre_m(box.min).head<2>() - Eigen::Vector2d::Constant(kMargin_m);
  const Eigen::Vector2d size_m =
      map.lattice().centre_m(box.max).head<2>() + Eigen::Vector2d::Constant(kMargin_m) - min_m;
  const double points_per_metre = width / size_m.maxCoeff();
  return {
      {top_left.x(), top_left.y(), points_per_metre * size_m.x(), points_per_metre * size_m.y()},
      min_m,
      points_per_metre};
}

void draw_way(Canvas& canvas, const TopView& view, const std::vector<Capture>& captures) {
  std::vector<Eigen::Vector2d> way;
  for (const Capture& capture : captures) {
    way.push_back(view.to_page(capture.T_map_base.translation().head<2>()));
  }
  canvas.stroke_open(way, {style::kPaper.with_alpha(0.8), 4.0});
  canvas.stroke_open(way, style::chosen_stroke());
}

/// A short line from the base to where the camera looks, for some of the captures.
void draw_looks(Canvas& canvas, const TopView& view, const std::vector<Capture>& captures,
                const Mast& mast) {
  constexpr std::size_t kMost = 150;
  constexpr double kLength = 13.0;
  const std::size_t stride = 1 + captures.size() / kMost;
  for (std::size_t i = 0; i < captures.size(); i += stride) {
    const Capture& capture = captures[i];
    const Eigen::Vector3d z_sensor_map =
        capture.T_map_base.linear() * mast.T_base_sensor(capture.joints).linear().col(2);
    const Eigen::Vector2d from = view.to_page(capture.T_map_base.translation().head<2>());
    const std::vector<Eigen::Vector2d> look{
        from, from + kLength * Eigen::Vector2d(z_sensor_map.x(), -z_sensor_map.y())};
    canvas.stroke_open(look, {style::kInk, 1.0});
  }
}

/// The map with what the robot did in it.
void draw_map(Canvas& canvas, const TopView& view, const EpisodePlotInput& input) {
  const auto grid = VoxelGrid::lazy(input.map);
  const Capture& last = input.captures.back();
  const double z_base_m = last.T_map_base.translation().z();
  canvas.clipped(view.panel, [&] {
    draw_voxels(canvas, view, *grid,
                map_slice(input.map.lattice(), z_base_m, z_base_m + last.joints.height_m,
                          input.robot.mast.height_max_m));
    draw_way(canvas, view, input.captures);
    draw_looks(canvas, view, input.captures, Mast(input.robot.mast));
    draw_robot(canvas, view, last.T_map_base, style::kChosen);
    draw_scale_bar(canvas, view);
  });
}

void draw_legend(Canvas& canvas, double y) {
  const std::vector<Eigen::Vector2d> way{{kLeft, y - 4.0}, {kLeft + 24.0, y - 4.0}};
  canvas.stroke_open(way, style::chosen_stroke());
  canvas.text({kLeft + 32.0, y}, "the base's way", style::body());
  const std::vector<Eigen::Vector2d> look{{kLeft + 160.0, y - 4.0}, {kLeft + 173.0, y - 4.0}};
  canvas.stroke_open(look, {style::kInk, 1.0});
  canvas.text({kLeft + 182.0, y}, "where the camera looks", style::body());
  draw_uncertainty_ramp(canvas, {kLeft + 380.0, y});
}

/// The information in the map over time.
void draw_information(Canvas& canvas, const Rectangle& panel,
                      const std::vector<Capture>& captures) {
  const double last_s = std::max(captures.back().time_s, 1e-9);
  const double most = std::max(captures.back().information, 1e-9);
  const auto to_x = [&](double time_s) { return panel.x + panel.width * time_s / last_s; };
  const auto to_y = [&](double information) {
    return panel.bottom() - panel.height * information / most;
  };
  std::vector<Eigen::Vector2d> line;
  for (const Capture& capture : captures) {
    line.emplace_back(to_x(capture.time_s), to_y(capture.information));
  }
  canvas.stroke_open(line, style::chosen_stroke());
  canvas.stroke(panel, {style::kMutedInk, 1.0});
  draw_axis_below(canvas, panel, make_ticks(0.0, last_s, 9), to_x, "time (s)");
  draw_axis_left(canvas, panel, make_ticks(0.0, most, 4), to_y, "information (Eq. 11)", 8.0, 48.0);
}

}  // namespace

std::string episode_plot_png(const EpisodePlotInput& input) {
  const TopView view = top_view(input.map, {kLeft, kTop}, kPageWidth - kLeft - kRight);
  const double below_map = view.panel.bottom() + kLegendHeight;
  Canvas canvas(kPageWidth, below_map + kChartHeight + kChartAxisHeight, kPixelsPerPoint);
  canvas.text({24.0, 40.0}, "What the robot has mapped", style::title());
  canvas.text({24.0, 62.0}, subtitle(input.report), style::note());

  draw_map(canvas, view, input);
  draw_axes(canvas, view);
  draw_legend(canvas, view.panel.bottom() + 64.0);
  draw_information(canvas, {kLeft, below_map, kPageWidth - kLeft - kRight, kChartHeight},
                   input.captures);
  return canvas.png();
}

std::string episode_map_png(const EpisodePlotInput& input) {
  constexpr double kWidth = 420.0;
  const TopView view = top_view(input.map, {0.0, 0.0}, kWidth);
  Canvas canvas(view.panel.width, view.panel.height, kPixelsPerPoint);
  draw_map(canvas, view, input);
  return canvas.png();
}

}  // namespace nbvopt
