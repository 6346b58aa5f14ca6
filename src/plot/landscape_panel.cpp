#include "plot/landscape_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/axis.hpp"
#include "plot/style.hpp"

namespace nbvopt {
namespace {

using Line = std::vector<Eigen::Vector2d>;

/// What the axes span, and where it lies on the page.
struct LandscapeChart {
  Rectangle panel;
  Eigen::Vector2d min_rad;  ///< pan, tilt
  Eigen::Vector2d max_rad;
  double gain_max;

  Eigen::Vector2d to_page(double pan_rad, double tilt_rad) const {
    const Eigen::Array2d share =
        (Eigen::Array2d(pan_rad, tilt_rad) - min_rad.array()) / (max_rad - min_rad).array();
    return {panel.x + share.x() * panel.width, panel.bottom() - share.y() * panel.height};
  }
  Eigen::Vector2d to_page(const JointPosition& q) const { return to_page(q.pan_rad, q.tilt_rad); }
};

LandscapeChart make_chart(const Rectangle& panel, const PlotInput& input) {
  // A frozen joint is drawn with some room on both sides; no gain at all still has a scale.
  constexpr double kLeastWidth_rad = 0.2;
  const auto box_min = input.result.box.min.head<2>().array();
  const auto box_max = input.result.box.max.head<2>().array();
  const Eigen::Array2d half_width = 0.5 * (box_max - box_min).max(kLeastWidth_rad);
  const Eigen::Array2d middle = 0.5 * (box_min + box_max);
  const std::vector<double>& gain = input.landscape.gain;
  return {panel, middle - half_width, middle + half_width,
          std::max(1.0, *std::max_element(gain.begin(), gain.end()))};
}

void draw_gains(Canvas& canvas, const LandscapeChart& chart, const Landscape& landscape) {
  Raster raster{static_cast<int>(chart.panel.width), static_cast<int>(chart.panel.height), {}};
  const Eigen::Vector2d step_rad =
      (chart.max_rad - chart.min_rad).cwiseQuotient(Eigen::Vector2d(raster.columns, raster.rows));
  for (int row = 0; row < raster.rows; ++row) {
    const double tilt_rad = chart.max_rad.y() - (row + 0.5) * step_rad.y();
    for (int column = 0; column < raster.columns; ++column) {
      const double pan_rad = chart.min_rad.x() + (column + 0.5) * step_rad.x();
      raster.cells.push_back(
          style::gain_colour(landscape.interpolated(pan_rad, tilt_rad) / chart.gain_max));
    }
  }
  canvas.draw(raster, chart.panel);
}

void draw_axes(Canvas& canvas, const LandscapeChart& chart) {
  const Rectangle& panel = chart.panel;
  canvas.stroke(panel, {style::kMutedInk, 1.0});
  draw_axis_below(
      canvas, panel, make_ticks(chart.min_rad.x(), chart.max_rad.x(), 14),
      [&](double pan_rad) { return chart.to_page(pan_rad, 0.0).x(); }, "pan (rad)");
  draw_axis_left(
      canvas, panel, make_ticks(chart.min_rad.y(), chart.max_rad.y(), 5),
      [&](double tilt_rad) { return chart.to_page(0.0, tilt_rad).y(); }, "tilt (rad)", 12.0, 48.0);
}

void draw_scale(Canvas& canvas, const LandscapeChart& chart) {
  const Rectangle bar{chart.panel.right() + 20.0, chart.panel.y, 14.0, chart.panel.height};
  Raster ramp{1, 128, {}};
  for (int row = 0; row < ramp.rows; ++row) {
    ramp.cells.push_back(style::gain_colour(1.0 - row / (ramp.rows - 1.0)));
  }
  canvas.draw(ramp, bar);
  canvas.stroke(bar, {style::kMutedInk, 1.0});
  const Ticks gains = make_ticks(0.0, chart.gain_max, 5);
  for (const double gain : gains.values) {
    const double y = bar.bottom() - gain / chart.gain_max * bar.height;
    canvas.stroke_open(Line{{bar.right(), y}, {bar.right() + 4.0, y}}, {style::kMutedInk, 1.0});
    canvas.text({bar.right() + 8.0, y + 4.0}, gains.label(gain), style::note());
  }
  canvas.text({bar.x, bar.y - 8.0}, "gain", style::body());
}

// The marks carry a light rim or a dark one, so that they stand out from every colour of the map.

void mark_evaluation(Canvas& canvas, const Eigen::Vector2d& at) {
  canvas.disc(at, 1.9, style::kPaper, {style::kInk.with_alpha(0.7), 0.7});
}

void mark_candidate(Canvas& canvas, const Eigen::Vector2d& at) {
  constexpr double kHalf = 4.5;
  const Rectangle square{at.x() - kHalf, at.y() - kHalf, 2.0 * kHalf, 2.0 * kHalf};
  canvas.stroke(square, {style::kInk.with_alpha(0.8), 3.4});
  canvas.stroke(square, {style::kPaper, 2.0});
}

void mark_path(Canvas& canvas, const Line& path) {
  canvas.stroke_open(path, {style::kInk.with_alpha(0.75), 3.2});
  canvas.stroke_open(path, {style::kPath, 1.6});
}

void mark_start(Canvas& canvas, const Eigen::Vector2d& at) {
  canvas.disc(at, 7.0, style::kPaper, {style::kPaper, 2.0});
  canvas.disc(at, 5.5, style::kPaper, {style::kCurrent, 2.5});
}

void mark_answer(Canvas& canvas, const Eigen::Vector2d& at) {
  canvas.disc(at, 7.0, style::kPaper, {style::kPaper, 2.0});
  canvas.disc(at, 5.5, style::kChosen, {style::kChosen, 2.0});
}

void draw_marks(Canvas& canvas, const LandscapeChart& chart, const PlotInput& input) {
  Line path;
  for (const TracePoint& point : improvements(input.result.trace)) {
    path.push_back(chart.to_page(point.joints));
  }
  mark_path(canvas, path);
  for (const double pan_rad : input.candidate_pans_rad) {
    mark_candidate(canvas, chart.to_page(pan_rad, input.result.request.joints.tilt_rad));
  }
  for (const TracePoint& point : input.result.trace) {
    mark_evaluation(canvas, chart.to_page(point.joints));
  }
  mark_start(canvas, chart.to_page(input.result.request.joints));
  mark_answer(canvas, chart.to_page(input.result.joints));
}

/// One row of marks with their names, from the left.
class Legend {
 public:
  Legend(Canvas& canvas, const Eigen::Vector2d& left) : canvas_(canvas), at_(left) {}

  template <typename Mark>
  void add(const Mark& mark, const std::string& label) {
    constexpr double kMark = 24.0;
    constexpr double kGap = 28.0;
    mark(at_ + Eigen::Vector2d(0.5 * kMark, -4.0));
    canvas_.text(at_ + Eigen::Vector2d(kMark + 8.0, 0.0), label, style::body());
    at_.x() += kMark + 8.0 + canvas_.text_width(label, style::body()) + kGap;
  }

 private:
  Canvas& canvas_;
  Eigen::Vector2d at_;  ///< the left end of the next mark, on the base line
};

void draw_legend(Canvas& canvas, const Rectangle& panel, const PlotInput& input) {
  Legend legend(canvas, {panel.x, panel.bottom() + 66.0});
  legend.add([&](const Eigen::Vector2d& at) { mark_start(canvas, at); }, "current view");
  legend.add([&](const Eigen::Vector2d& at) { mark_answer(canvas, at); }, "chosen view");
  legend.add([&](const Eigen::Vector2d& at) { mark_evaluation(canvas, at); },
             "evaluated, at any height");
  legend.add(
      [&](const Eigen::Vector2d& at) {
        const Eigen::Vector2d half(12.0, 0.0);
        mark_path(canvas, {at - half, at + half});
      },
      "from best to better");
  if (!input.candidate_pans_rad.empty()) {
    legend.add([&](const Eigen::Vector2d& at) { mark_candidate(canvas, at); },
               "the paper's pan grid");
  }
}

}  // namespace

void draw_landscape(Canvas& canvas, const Rectangle& panel, const PlotInput& input) {
  const LandscapeChart chart = make_chart(panel, input);
  draw_gains(canvas, chart, input.landscape);
  draw_axes(canvas, chart);
  draw_scale(canvas, chart);
  draw_marks(canvas, chart, input);
  draw_legend(canvas, panel, input);
}

}  // namespace nbvopt
