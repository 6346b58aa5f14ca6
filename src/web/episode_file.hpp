// The captures of an episode, as `nbvopt simulate --metrics` writes them, read again.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/mast/mast.hpp"

namespace nbvopt {

/// One capture, as far as a page shows it.
struct EpisodeCapture {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  double time_s = 0.0;
  Transform T_map_base = Transform::Identity();  ///< as the base believes
  JointPosition joints;
  double information = 0.0;  ///< of the map, this capture included
  double predicted_gain = kNaN;
  double realised_gain = kNaN;
};

/// More captures are not shown: each has a number of 16 bits.
inline constexpr std::size_t kMostCaptures = 65535;

/// Reads a JSON object a line; `name` stands for the file in messages. Throws InputError that names
/// the file, the line and the key where one is no JSON, a key is missing or of another type, and
/// beyond kMostCaptures.
std::vector<EpisodeCapture> parse_episode_file(const std::string& lines, const std::string& name);

}  // namespace nbvopt
