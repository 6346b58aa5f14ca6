#include "cli/plot_axis.hpp"

#include <algorithm>
#include <cmath>

#include "cli/plot_style.hpp"

namespace nbvopt {
namespace {

using Line = std::vector<Eigen::Vector2d>;

constexpr double kTick = 4.0;
const Stroke kTickStroke{style::kMutedInk, 1.0};

}  // namespace

std::string Ticks::label(double value) const {
  const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return decimal(value, digits);
}

Ticks make_ticks(double min, double max, int count) {
  const double rough = (max - min) / count;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  Ticks ticks{.step = 10.0 * decade, .values = {}};
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * decade >= rough) ticks.step = factor * decade;
  }
  const double first = std::ceil(min / ticks.step);
  const double last = std::floor(max / ticks.step);
  for (double i = first; i <= last; ++i) ticks.values.push_back(i * ticks.step);
  return ticks;
}

void draw_axis_below(Canvas& canvas, const Rectangle& panel, const Ticks& ticks,
                     const ToPage& to_page_x, const std::string& title) {
  for (const double value : ticks.values) {
    const double x = to_page_x(value);
    canvas.stroke_open(Line{{x, panel.bottom()}, {x, panel.bottom() + kTick}}, kTickStroke);
    canvas.text({x, panel.bottom() + 17.0}, ticks.label(value), style::note(Anchor::centre));
  }
  canvas.text({panel.x + 0.5 * panel.width, panel.bottom() + 34.0}, title,
              style::body(Anchor::centre));
}

void draw_axis_left(Canvas& canvas, const Rectangle& panel, const Ticks& ticks,
                    const ToPage& to_page_y, const std::string& title, double label_gap,
                    double title_gap) {
  for (const double value : ticks.values) {
    const double y = to_page_y(value);
    canvas.stroke_open(Line{{panel.x - kTick, y}, {panel.x, y}}, kTickStroke);
    canvas.text({panel.x - label_gap, y + 4.0}, ticks.label(value), style::note(Anchor::right));
  }
  canvas.upright_text({panel.x - title_gap, panel.y + 0.5 * panel.height}, title,
                      style::body(Anchor::centre));
}

}  // namespace nbvopt
