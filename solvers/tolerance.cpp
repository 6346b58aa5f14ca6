#include "solvers/tolerance.hpp"

#include <cmath>
#include <sstream>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

double checked_tolerance(double tolerance) {
  if (std::isfinite(tolerance) && tolerance > 0.0) return tolerance;
  std::ostringstream text;
  text << "tolerance = " << tolerance << ": give a finite number of length scales above 0";
  throw UsageError(text.str());
}

}  // namespace nbvopt
