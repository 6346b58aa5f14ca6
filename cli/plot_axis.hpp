// The scale of an axis.
#pragma once

#include <string>
#include <vector>

namespace nbvopt {

/// Round numbers along an axis: 1, 2 or 5 times a power of ten apart.
struct Ticks {
  double step = 1.0;
  std::vector<double> values;

  /// A value with as many digits as the step needs.
  std::string label(double value) const;
};

/// About `count` ticks within [min, max], min < max.
Ticks make_ticks(double min, double max, int count);

}  // namespace nbvopt
