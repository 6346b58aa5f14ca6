#include "cli/plot_axis.hpp"

#include <algorithm>
#include <cmath>

#include "cli/canvas.hpp"

namespace nbvopt {

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

}  // namespace nbvopt
