#include "plot/query_plot.hpp"

#include <array>
#include <cmath>
#include <string>

#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "plot/canvas.hpp"
#include "plot/gain_panel.hpp"
#include "plot/landscape_panel.hpp"
#include "plot/map_panel.hpp"
#include "plot/style.hpp"

namespace nbvopt {
namespace {

constexpr double kPixelsPerPoint = 2.0;
constexpr double kPageWidth = 1160.0;
constexpr double kPageHeight = 1066.0;
constexpr Rectangle kMapPanel{72.0, 108.0, 560.0, 560.0};
constexpr Rectangle kGainPanel{728.0, 220.0, 392.0, 304.0};
constexpr Rectangle kLandscapePanel{72.0, 774.0, 958.0, 200.0};
constexpr double kRight = 672.0;  ///< where the right-hand column starts

void draw_title(Canvas& canvas, const PlotInput& input, const MapSlice& slice) {
  const PlanResult& result = input.result;
  const std::string surrogate =
      result.surrogate_evaluations > 0
          ? " and " + std::to_string(result.surrogate_evaluations) + " by its surrogate"
          : "";
  canvas.text({24.0, 42.0}, "Where should the camera look next?", style::title());
  canvas.text({24.0, 63.0},
              result.solver + " solver, " + std::to_string(result.evaluations) +
                  " views judged by the " + input.planner.evaluator() + " gain (" +
                  to_string(input.planner.robot().sensor.counting) + ")" + surrogate + " in " +
                  decimal(result.search_time_ms, 1) + " ms",
              style::note());
  canvas.text({kMapPanel.x, kMapPanel.y - 8.0}, "Map from above", style::heading());
  canvas.text({kMapPanel.right(), kMapPanel.y - 8.0},
              "occupied between z = " + decimal(slice.z_min_m, 2) + " and " +
                  decimal(slice.z_max_m, 2) + " m, else as at z = " + decimal(slice.z_camera_m, 2) +
                  " m",
              style::note(Anchor::right));
}

void draw_table_row(Canvas& canvas, double y, const std::string& name,
                    const std::array<std::string, 4>& cells, bool bold) {
  constexpr std::array<double, 4> kRightEdges{870.0, 950.0, 1034.0, 1120.0};
  TextStyle style = style::body();
  style.bold = bold;
  canvas.text({kRight + 34.0, y}, name, style);
  style.anchor = Anchor::right;
  for (std::size_t i = 0; i < cells.size(); ++i) canvas.text({kRightEdges[i], y}, cells[i], style);
}

std::array<std::string, 4> view_cells(const JointPosition& joints, const ViewGain& view) {
  return {decimal(joints.pan_rad, 3), decimal(joints.tilt_rad, 3), decimal(joints.height_m, 3),
          decimal(view.gain, 1)};
}

/// A short stretch of a view's line, as in the map.
void draw_key_line(Canvas& canvas, double x, double y, const Stroke& stroke) {
  const std::array<Eigen::Vector2d, 2> line{{{x, y}, {x + 24.0, y}}};
  canvas.stroke_open(line, stroke);
}

void draw_table(Canvas& canvas, const PlotInput& input) {
  const PlanResult& result = input.result;
  constexpr double kTop = kMapPanel.y - 8.0;
  draw_table_row(canvas, kTop, "View", {"pan (rad)", "tilt (rad)", "height (m)", "gain"}, true);
  canvas.fill(Rectangle{kRight, kTop + 8.0, kGainPanel.right() - kRight, 1.0}, style::kMutedInk);
  draw_key_line(canvas, kRight, kTop + 24.0, style::current_stroke());
  draw_table_row(canvas, kTop + 28.0, "current", view_cells(result.request.joints, result.current),
                 false);
  draw_key_line(canvas, kRight, kTop + 46.0, style::chosen_stroke());
  draw_table_row(canvas, kTop + 50.0, "chosen", view_cells(result.joints, result.view), false);
  canvas.text({kRight, kTop + 72.0},
              to_string(result.status) + ", move of " + decimal(result.move_time_s, 2) + " s",
              style::note());
}

void draw_swatch(Canvas& canvas, double x, double y, Colour colour, const std::string& label) {
  const Rectangle box{x, y - 10.0, 24.0, 12.0};
  canvas.fill(box, colour);
  canvas.stroke(box, {style::kMutedInk, 0.6});
  canvas.text({x + 32.0, y}, label, style::body());
}

void draw_legend(Canvas& canvas, const PlotInput& input) {
  constexpr double kTop = 604.0;
  constexpr double kSecondColumn = kRight + 226.0;
  draw_swatch(canvas, kRight, kTop, style::kUnknownGain.with_alpha(0.7),
              "gain from unknown voxels");
  draw_swatch(canvas, kSecondColumn, kTop, style::kOccupiedGain.with_alpha(0.7),
              "gain from badly seen voxels");
  draw_swatch(canvas, kRight, kTop + 24.0, style::kFree, "free");
  draw_swatch(canvas, kSecondColumn, kTop + 24.0, style::kUnknown, "unknown");
  if (input.planner.grid()->carries_uncertainty()) {
    draw_uncertainty_ramp(canvas, {kRight, kTop + 48.0});
  } else {
    draw_swatch(canvas, kRight, kTop + 48.0, style::kOccupied, "occupied");
  }
  if (!input.candidate_pans_rad.empty()) {
    canvas.disc({kRight + 12.0, kTop + 86.0}, 3.0, style::kPaper, {style::kInk, 1.2});
    canvas.text({kRight + 32.0, kTop + 90.0}, "pan angles of the paper's grid", style::body());
  }
}

}  // namespace

std::string plot_png(const PlotInput& input) {
  Canvas canvas(kPageWidth, kPageHeight, kPixelsPerPoint);
  const MapSlice slice = map_slice(input);
  draw_title(canvas, input, slice);
  draw_map(canvas, kMapPanel, input, slice);
  draw_table(canvas, input);
  canvas.text({kRight, kGainPanel.y - 10.0}, "Gain against pan, at the chosen tilt and height",
              style::heading());
  draw_gain(canvas, kGainPanel, input);
  draw_legend(canvas, input);
  canvas.text({kLandscapePanel.x, kLandscapePanel.y - 10.0},
              "Gain over pan and tilt, at the chosen height of " +
                  decimal(input.landscape.height_m, 3) + " m",
              style::heading());
  draw_landscape(canvas, kLandscapePanel, input);
  return canvas.png();
}

void write_plot(const PlotInput& input, const std::filesystem::path& path) {
  write_file_atomically(path, plot_png(input));
}

}  // namespace nbvopt
