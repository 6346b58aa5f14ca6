// Lines over an axis, as many as there are solvers in a study.
#pragma once

#include <string>
#include <vector>

#include "plot/axis.hpp"
#include "plot/canvas.hpp"

namespace nbvopt {

enum class LineMark { none, disc, square, diamond, triangle };

/// How a line looks, in the chart and in the legend.
struct LineStyle {
  Stroke stroke;
  LineMark mark = LineMark::none;
};

struct ChartAxis {
  double min = 0.0;
  double max = 1.0;
  bool is_logarithmic = false;
  std::vector<Tick> ticks;
  std::string title;

  /// Where a value lies between the ends, from 0 to 1.
  double share(double value) const;
};

struct ChartLine {
  std::vector<Eigen::Vector2d> points;  ///< in the axes' units; a NaN parts the line
  LineStyle style;
  std::size_t marks_every = 1;  ///< points from mark to mark
  std::size_t first_mark = 0;
};

/// What lies between two lines of the same x.
struct ChartBand {
  std::vector<Eigen::Vector2d> lower;  ///< in the axes' units
  std::vector<Eigen::Vector2d> upper;
  Colour colour;
};

/// Draws bands below lines, the last on top, over their grid; the axes' texts lie outside the
/// panel. What lies beyond the axes' ends is cut.
void draw_line_chart(Canvas& canvas, const Rectangle& panel, const ChartAxis& x_axis,
                     const ChartAxis& y_axis, const std::vector<ChartLine>& lines,
                     const std::vector<ChartBand>& bands = {});

/// A short piece of a line with its mark in the middle, `left` its left end.
void draw_line_sample(Canvas& canvas, const Eigen::Vector2d& left, double length,
                      const LineStyle& style);

}  // namespace nbvopt
