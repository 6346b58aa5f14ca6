#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "map/point_records.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

constexpr std::string_view kSeparators = " \t\r,;";

bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//") || line.starts_with('%');
}

/// Where x, y and z stand in a line of names, such as "time,x,y,z"; none where it has not all.
std::optional<std::array<std::size_t, 3>> named_columns(const std::string& line) {
  Words words(line, kSeparators);
  std::vector<std::string> names = words.rest();
  std::array<std::size_t, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::ranges::find_if(names, [axis](const std::string& name) {
      return lower_case(name) == "xyz"[axis] + std::string();
    });
    if (found == names.end()) return std::nullopt;
    columns[axis] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

bool starts_with_number(const std::string& line) {
  return parse_scan_number(Words(line, kSeparators).next()).has_value();
}

/// The number of points alone, with which .pts files start.
bool is_count(const std::string& line) {
  Words words(line, kSeparators);
  return parse_whole_number(words.next()) && words.next().empty();
}

}  // namespace

Scan read_xyz(std::istream& in_stream, const std::string& name) {
  ScanInput in(in_stream, name);
  std::array<std::size_t, 3> columns{0, 1, 2};
  std::vector<double> numbers;
  Scan scan;
  bool is_first = true;
  while (const auto line = in.next_line()) {
    if (is_comment(*line)) continue;
    if (std::exchange(is_first, false)) {
      if (is_count(*line)) continue;
      if (!starts_with_number(*line)) {
        const auto named = named_columns(*line);
        if (!named)
          in.refuse_line(
              "neither a point 'x y z' nor the names of columns; scans are PLY, PCD, text with a "
              "point a "
              "line, PNG or PGM");
        columns = *named;
        continue;
      }
    }
    Words words(*line, kSeparators);
    numbers.resize(1 + *std::ranges::max_element(columns));
    in.parse_numbers(words, numbers);
    scan.points_m.push_back(
        Eigen::Vector3d(numbers[columns[0]], numbers[columns[1]], numbers[columns[2]])
            .cast<float>());
  }
  return scan;
}

}  // namespace nbvopt
