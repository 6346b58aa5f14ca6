// The check of SolverOptions::tolerance.
#pragma once

namespace nbvopt {

/// The tolerance as it is. Throws UsageError unless it is above 0 and finite.
double checked_tolerance(double tolerance);

}  // namespace nbvopt
