#include "plot/line_chart.hpp"

#include <cmath>
#include <ranges>

#include "plot/style.hpp"

namespace nbvopt {
namespace {

using Line = std::vector<Eigen::Vector2d>;

void draw_mark(Canvas& canvas, const Eigen::Vector2d& at, const LineStyle& line) {
  const auto polygon = [&](const Line& corners) {
    Line moved;
    for (const Eigen::Vector2d& corner : corners) moved.push_back(at + corner);
    canvas.fill(moved, line.stroke.colour);
    canvas.stroke_closed(moved, {style::kPaper, 0.8});
  };
  switch (line.mark) {
    case LineMark::none:
      return;
    case LineMark::disc:
      return canvas.disc(at, 3.6, line.stroke.colour, {style::kPaper, 0.8});
    case LineMark::square:
      return polygon({{-3.3, -3.3}, {3.3, -3.3}, {3.3, 3.3}, {-3.3, 3.3}});
    case LineMark::diamond:
      return polygon({{0.0, -4.8}, {4.8, 0.0}, {0.0, 4.8}, {-4.8, 0.0}});
    case LineMark::triangle:
      return polygon({{0.0, -4.6}, {4.4, 3.4}, {-4.4, 3.4}});
  }
}

void draw_line(Canvas& canvas, const Line& points, const ChartLine& line) {
  const Eigen::Vector2d kHalfDash(7.0, 0.0);
  Line piece;
  const auto finish = [&] {
    // A lone point would not show.
    if (piece.size() == 1) piece = {piece[0] - kHalfDash, piece[0] + kHalfDash};
    canvas.stroke_open(piece, line.style.stroke);
    piece.clear();
  };
  for (const Eigen::Vector2d& point : points) {
    if (point.allFinite()) {
      piece.push_back(point);
    } else {
      finish();
    }
  }
  finish();
  for (std::size_t i = line.first_mark; i < points.size(); i += line.marks_every) {
    if (points[i].allFinite()) draw_mark(canvas, points[i], line.style);
  }
}

void draw_grid(Canvas& canvas, const Rectangle& panel, const ChartAxis& x_axis,
               const ChartAxis& y_axis) {
  const Stroke stroke{style::kGridLine, 1.0};
  for (const Tick& tick : x_axis.ticks) {
    const double x = panel.x + x_axis.share(tick.value) * panel.width;
    canvas.stroke_open(Line{{x, panel.y}, {x, panel.bottom()}}, stroke);
  }
  for (const Tick& tick : y_axis.ticks) {
    const double y = panel.bottom() - y_axis.share(tick.value) * panel.height;
    canvas.stroke_open(Line{{panel.x, y}, {panel.right(), y}}, stroke);
  }
}

}  // namespace

double ChartAxis::share(double value) const {
  if (is_logarithmic) return std::log(value / min) / std::log(max / min);
  return (value - min) / (max - min);
}

void draw_line_chart(Canvas& canvas, const Rectangle& panel, const ChartAxis& x_axis,
                     const ChartAxis& y_axis, const std::vector<ChartLine>& lines,
                     const std::vector<ChartBand>& bands) {
  constexpr double kRoom = 6.0;  // for marks on the edge
  const auto to_x = [&](double value) { return panel.x + x_axis.share(value) * panel.width; };
  const auto to_y = [&](double value) {
    return panel.bottom() - y_axis.share(value) * panel.height;
  };
  draw_grid(canvas, panel, x_axis, y_axis);
  const Rectangle roomy{panel.x - kRoom, panel.y - kRoom, panel.width + 2.0 * kRoom,
                        panel.height + 2.0 * kRoom};
  const auto append = [&](Line& points, const auto& of) {
    for (const Eigen::Vector2d& point : of) points.emplace_back(to_x(point.x()), to_y(point.y()));
  };
  canvas.clipped(roomy, [&] {
    for (const ChartBand& band : bands) {
      Line outline;
      append(outline, band.lower);
      append(outline, std::views::reverse(band.upper));
      canvas.fill(outline, band.colour);
    }
    for (const ChartLine& line : lines) {
      Line points;
      append(points, line.points);
      draw_line(canvas, points, line);
    }
  });
  canvas.stroke_open(
      Line{{panel.x, panel.y}, {panel.x, panel.bottom()}, {panel.right(), panel.bottom()}},
      {style::kMutedInk, 1.0});
  draw_axis_below(canvas, panel, x_axis.ticks, to_x, x_axis.title);
  draw_axis_left(canvas, panel, y_axis.ticks, to_y, y_axis.title, 9.0, 60.0);
}

void draw_line_sample(Canvas& canvas, const Eigen::Vector2d& left, double length,
                      const LineStyle& style) {
  canvas.stroke_open(Line{left, {left.x() + length, left.y()}}, style.stroke);
  draw_mark(canvas, {left.x() + 0.5 * length, left.y()}, style);
}

}  // namespace nbvopt
