#include "plot/axis.hpp"

#include <algorithm>
#include <cmath>

#include "core/number.hpp"
#include "plot/style.hpp"

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

std::vector<Tick> labelled(const Ticks& ticks) {
  std::vector<Tick> labelled;
  for (const double value : ticks.values) labelled.push_back({value, ticks.label(value)});
  return labelled;
}

std::vector<Tick> make_log_ticks(double min, double max) {
  constexpr double kRounding = 1e-9;
  const auto within = [&](const std::vector<double>& factors) {
    std::vector<Tick> ticks;
    for (double power = std::floor(std::log10(min)); power <= std::log10(max); ++power) {
      const int digits = std::max(0, -static_cast<int>(power));
      for (const double factor : factors) {
        const double value = factor * std::pow(10.0, power);
        if (value < min * (1.0 - kRounding) || value > max * (1.0 + kRounding)) continue;
        ticks.push_back({value, power >= 3.0 ? grouped(value) : decimal(value, digits)});
      }
    }
    return ticks;
  };
  const std::vector<Tick> decades = within({1.0});
  return decades.size() < 2 ? within({1.0, 2.0, 5.0}) : decades;
}

void draw_axis_below(Canvas& canvas, const Rectangle& panel, const std::vector<Tick>& ticks,
                     const ToPage& to_page_x, const std::string& title) {
  for (const Tick& tick : ticks) {
    const double x = to_page_x(tick.value);
    canvas.stroke_open(Line{{x, panel.bottom()}, {x, panel.bottom() + kTick}}, kTickStroke);
    canvas.text({x, panel.bottom() + 17.0}, tick.label, style::note(Anchor::centre));
  }
  canvas.text({panel.x + 0.5 * panel.width, panel.bottom() + 34.0}, title,
              style::body(Anchor::centre));
}

void draw_axis_below(Canvas& canvas, const Rectangle& panel, const Ticks& ticks,
                     const ToPage& to_page_x, const std::string& title) {
  draw_axis_below(canvas, panel, labelled(ticks), to_page_x, title);
}

void draw_axis_left(Canvas& canvas, const Rectangle& panel, const std::vector<Tick>& ticks,
                    const ToPage& to_page_y, const std::string& title, double label_gap,
                    double title_gap) {
  for (const Tick& tick : ticks) {
    const double y = to_page_y(tick.value);
    canvas.stroke_open(Line{{panel.x - kTick, y}, {panel.x, y}}, kTickStroke);
    canvas.text({panel.x - label_gap, y + 4.0}, tick.label, style::note(Anchor::right));
  }
  canvas.upright_text({panel.x - title_gap, panel.y + 0.5 * panel.height}, title,
                      style::body(Anchor::centre));
}

void draw_axis_left(Canvas& canvas, const Rectangle& panel, const Ticks& ticks,
                    const ToPage& to_page_y, const std::string& title, double label_gap,
                    double title_gap) {
  draw_axis_left(canvas, panel, labelled(ticks), to_page_y, title, label_gap, title_gap);
}

}  // namespace nbvopt
