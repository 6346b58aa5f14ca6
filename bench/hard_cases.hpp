// The starts that auto loses most, of those that chance drew: what it finds there.
#pragma once

#include <string>

namespace nbvopt::bench {

/// A row a case of datasets/hard/cases.json with the share of the best known gain that auto finds,
/// and the mean, the worst and the time over all, on one core. Takes a second.
std::string measure_hard_cases();

}  // namespace nbvopt::bench
