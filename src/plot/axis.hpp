// The scale of an axis, and how it is drawn.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plot/canvas.hpp"

namespace nbvopt {

/// Round numbers along an axis: 1, 2 or 5 times a power of ten apart.
struct Ticks {
  double step = 1.0;
  std::vector<double> values;

  /// A value with as many digits as the step needs.
  std::string label(double value) const;
};

/// A named place along an axis.
struct Tick {
  double value = 0.0;
  std::string label;
};

/// The same with their labels.
std::vector<Tick> labelled(const Ticks& ticks);

/// Ticks along a logarithmic axis within [min, max], 0 < min < max: powers of ten, with twice and
/// five times them where there would be less than two.
std::vector<Tick> make_log_ticks(double min, double max);

/// About `count` ticks within [min, max], min < max.
Ticks make_ticks(double min, double max, int count);

/// Where a value lies along an axis, in page coordinates.
using ToPage = std::function<double(double value)>;

/// Ticks, their labels and the title below a panel.
void draw_axis_below(Canvas& canvas, const Rectangle& panel, const std::vector<Tick>& ticks,
                     const ToPage& to_page_x, const std::string& title);
void draw_axis_below(Canvas& canvas, const Rectangle& panel, const Ticks& ticks,
                     const ToPage& to_page_x, const std::string& title);

/// The same to its left; `label_gap` and `title_gap` are points from the panel.
void draw_axis_left(Canvas& canvas, const Rectangle& panel, const std::vector<Tick>& ticks,
                    const ToPage& to_page_y, const std::string& title, double label_gap,
                    double title_gap);
void draw_axis_left(Canvas& canvas, const Rectangle& panel, const Ticks& ticks,
                    const ToPage& to_page_y, const std::string& title, double label_gap,
                    double title_gap);

}  // namespace nbvopt
