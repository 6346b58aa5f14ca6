// Information over time, by camera.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nbvopt/sim/information_growth.hpp"

namespace nbvopt {

/// One setting's growths, one a drive.
struct GrowthSeries {
  std::string label;
  std::size_t line = 0;                           ///< the same number is drawn the same way
  std::vector<const InformationGrowth*> growths;  ///< at least one
};

/// A line a setting, the mean of its drives, within a band from the least to the most of them. A
/// drive keeps after its end what it has. The bytes of a PNG file.
std::string growth_chart_png(const std::string& title, const std::vector<GrowthSeries>& series);

}  // namespace nbvopt
