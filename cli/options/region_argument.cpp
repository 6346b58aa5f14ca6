#include "cli/options/region_argument.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include "cli/options/arguments.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

std::optional<Eigen::Vector2d> corner_in(std::string line) {
  std::ranges::replace(line, ',', ' ');
  std::istringstream words(line);
  std::string x_text;
  std::string y_text;
  std::string more;
  if (!(words >> x_text >> y_text) || words >> more) return std::nullopt;
  const std::optional<double> x = parse_number(x_text);
  const std::optional<double> y = parse_number(y_text);
  if (!x || !y) return std::nullopt;
  return Eigen::Vector2d(*x, *y);
}

std::vector<Eigen::Vector2d> corners_in(const std::string& file) {
  std::istringstream lines(read_text_file(file));
  std::vector<Eigen::Vector2d> corners;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::optional<Eigen::Vector2d> corner = corner_in(line);
    if (!corner) {
      throw InputError(file + ": line " + std::to_string(number) +
                       " is no corner of a region, it must be two numbers: x,y");
    }
    corners.push_back(*corner);
  }
  if (corners.size() < 3) {
    throw InputError(file + ": a region has 3 corners or more, here are " +
                     std::to_string(corners.size()));
  }
  return corners;
}

}  // namespace

std::vector<Eigen::Vector2d> region_argument(const std::string& text) {
  if (std::filesystem::exists(text)) return corners_in(text);
  if (text.find(',') == std::string::npos) read_text_file(text);  // says why there is no file
  const std::vector<double> ends = numbers_argument("--region", text, {4}, "X0,Y0,X1,Y1");
  return {{ends[0], ends[1]}, {ends[2], ends[1]}, {ends[2], ends[3]}, {ends[0], ends[3]}};
}

}  // namespace nbvopt
