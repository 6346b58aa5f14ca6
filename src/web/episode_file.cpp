#include "web/episode_file.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "web/members.hpp"

namespace nbvopt {
namespace {

/// x, y, z and yaw.
Transform base(const Members& capture) {
  const Json& base = capture.at("base");
  const auto is_number = [](const Json& value) { return value.is_number(); };
  if (!base.is_array() || base.size() != 4 || !std::all_of(base.begin(), base.end(), is_number)) {
    throw InputError(capture.where + ": 'base' must be a list of 4 numbers");
  }
  const auto numbers = base.get<std::array<double, 4>>();
  return base_pose(numbers[0], numbers[1], numbers[2], numbers[3]);
}

double number_or_nan(const Members& capture, const char* key) {
  return capture.at(key).is_null() ? EpisodeCapture::kNaN : capture.number(key);
}

}  // namespace

std::vector<EpisodeCapture> parse_episode_file(const std::string& lines, const std::string& name) {
  if (std::count(lines.begin(), lines.end(), '\n') > static_cast<std::ptrdiff_t>(kMostCaptures)) {
    throw InputError(name + ": more than " + std::to_string(kMostCaptures) +
                     " captures, give a part of the file");
  }
  std::vector<EpisodeCapture> captures;
  std::istringstream in(lines);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string where = name + ": line " + std::to_string(number);
    Json json;
    try {
      json = Json::parse(line);
    } catch (const Json::exception&) {
      throw InputError(where + ": not valid JSON, give what nbvopt simulate --metrics wrote");
    }
    const Members capture{json, where, "nbvopt simulate --metrics"};
    captures.push_back({.time_s = capture.number("time_s"),
                        .T_map_base = base(capture),
                        .joints = {.pan_rad = capture.number("pan"),
                                   .tilt_rad = capture.number("tilt"),
                                   .height_m = capture.number("height")},
                        .information = capture.number("information"),
                        .predicted_gain = number_or_nan(capture, "predicted_gain"),
                        .realised_gain = number_or_nan(capture, "realised_gain")});
  }
  return captures;
}

}  // namespace nbvopt
