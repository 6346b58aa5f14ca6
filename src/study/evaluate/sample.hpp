// What sums up a sample of numbers.
#pragma once

#include <vector>

namespace nbvopt::study {

/// NaN of no values.
double mean(const std::vector<double>& values);

/// The value below which a share, in [0, 1], of the sample lies; between two values it is
/// interpolated linearly, so 0.5 gives the median and 0 the least. NaN of no values.
double quantile(std::vector<double> values, double share);

}  // namespace nbvopt::study
