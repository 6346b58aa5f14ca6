#include "cli/options/start_place.hpp"

#include <cmath>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

std::vector<double> pose_of(const StartPlace& place) {
  // To the millimetre: what is shown can be typed again and gives the same drive. The base must
  // not start below its floor.
  const auto rounded = [](double value) { return std::round(1e3 * value) / 1e3; };
  constexpr double kGrain = 1e-3;  // of a millimetre: single precision, not another height
  const Eigen::Vector3d& position_m = place.position_map_m;
  return {rounded(position_m.x()), rounded(position_m.y()),
          std::ceil(1e3 * position_m.z() - kGrain) / 1e3, 0.0};
}

std::string pose_text(const std::vector<double>& pose) {
  std::string text;
  for (const double value : pose) text += (text.empty() ? "" : ",") + format_number(value + 0.0);
  return text;
}

std::vector<double> first_start(const Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                                const ExplorationOptions& options) {
  const WorldSurvey survey = survey_world(scene, bounds_m, options);
  if (!survey.starts.empty()) return pose_of(survey.starts.front());
  throw InputError("there is no place in the world where the base could start: no floor with " +
                   format_number(options.base.radius_m) + " m of room around, give a start");
}

}  // namespace nbvopt
