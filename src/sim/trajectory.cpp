#include "nbvopt/sim/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// The columns of the file, in order.
struct Column {
  std::string_view name;
  double TrajectoryPoint::*value;
};
constexpr std::array<Column, 5> kColumns{{{"time_s", &TrajectoryPoint::time_s},
                                          {"x_m", &TrajectoryPoint::x_m},
                                          {"y_m", &TrajectoryPoint::y_m},
                                          {"z_m", &TrajectoryPoint::z_m},
                                          {"yaw_rad", &TrajectoryPoint::yaw_rad}}};

/// What is wrong with a point that follows `previous` (null: the first); empty when nothing is.
std::string fault(const TrajectoryPoint& point, const TrajectoryPoint* previous) {
  for (const Column& column : kColumns) {
    if (!std::isfinite(point.*column.value)) {
      return std::string(column.name) + " is " + format_number(point.*column.value) +
             ", it must be finite";
    }
  }
  if (!previous && point.time_s != 0.0) {
    return "time_s is " + format_number(point.time_s) + ", a trajectory must start at 0";
  }
  if (previous && !(point.time_s > previous->time_s)) {
    return "time_s is " + format_number(point.time_s) + " after " +
           format_number(previous->time_s) + ", times must grow";
  }
  return {};
}

std::string header() {
  std::string line;
  for (const Column& column : kColumns) {
    line += (line.empty() ? "" : ",") + std::string(column.name);
  }
  return line;
}

/// The first line of the text, which it loses; a carriage return at the line's end goes too.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Reads one line; on a fault calls refuse(what), which throws.
template <class Refuse>
TrajectoryPoint parse_point(std::string_view line, const Refuse& refuse) {
  const auto separators = static_cast<std::size_t>(std::ranges::count(line, ','));
  if (separators + 1 != kColumns.size()) {
    refuse("has " + std::to_string(separators + 1) + " values, it must have " +
           std::to_string(kColumns.size()) + ": " + header());
  }
  TrajectoryPoint point;
  for (const Column& column : kColumns) {
    const std::string_view word = line.substr(0, line.find(','));
    line.remove_prefix(std::min(word.size() + 1, line.size()));
    const std::optional<double> value = parse_number(word);
    if (!value) {
      refuse(std::string(column.name) + " is '" + std::string(word.substr(0, 40)) +
             "', it must be a number");
    }
    point.*column.value = *value;
  }
  return point;
}

/// Throws unless the point may follow.
void require_next(const TrajectoryPoint& point, const TrajectoryPoint* previous,
                  std::size_t number) {
  const std::string what = fault(point, previous);
  if (!what.empty()) {
    throw InputError("trajectory point " + std::to_string(number) + ": " + what);
  }
}

}  // namespace

Trajectory::Trajectory(std::vector<TrajectoryPoint> points) : points_(std::move(points)) {
  if (points_.empty()) throw InputError("the trajectory has no point, it needs at least one");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    require_next(points_[i], i == 0 ? nullptr : &points_[i - 1], i + 1);
  }
}

void Trajectory::append(const TrajectoryPoint& point) {
  require_next(point, &points_.back(), points_.size() + 1);
  points_.push_back(point);
}

double Trajectory::length_m() const {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    length_m +=
        std::hypot(points_[i].x_m - points_[i - 1].x_m, points_[i].y_m - points_[i - 1].y_m);
  }
  return length_m;
}

Transform T_map_base_at(std::span<const TrajectoryPoint> points, double time_s) {
  const auto after = std::ranges::upper_bound(points, time_s, {}, &TrajectoryPoint::time_s);
  const TrajectoryPoint& next = after == points.end() ? points.back() : *after;
  const TrajectoryPoint& last = after == points.begin() ? next : *(after - 1);
  const double span_s = next.time_s - last.time_s;
  const double part = span_s > 0.0 ? (time_s - last.time_s) / span_s : 0.0;
  const auto between = [&](double TrajectoryPoint::*value) {
    return last.*value + part * (next.*value - last.*value);
  };
  return base_pose(between(&TrajectoryPoint::x_m), between(&TrajectoryPoint::y_m),
                   between(&TrajectoryPoint::z_m), between(&TrajectoryPoint::yaw_rad));
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  return parse_trajectory(read_text_file(path), path.string());
}

Trajectory parse_trajectory(const std::string& csv, const std::string& name) {
  std::string_view text = csv;
  int number = 1;
  const auto refuse = [&](const std::string& what) {
    throw InputError(name + ": line " + std::to_string(number) + ": " + what);
  };
  if (take_line(text) != header()) {
    refuse("is not the header of a trajectory, it must be " + header());
  }
  std::vector<TrajectoryPoint> points;
  while (!text.empty()) {
    ++number;
    const TrajectoryPoint point = parse_point(take_line(text), refuse);
    const std::string what = fault(point, points.empty() ? nullptr : &points.back());
    if (!what.empty()) refuse(what);
    points.push_back(point);
  }
  if (points.empty()) refuse("is the last one, a trajectory needs at least one point");
  return Trajectory(std::move(points));
}

void write_trajectory(const Trajectory& trajectory, const std::filesystem::path& path) {
  std::string text = header() + "\n";
  for (const TrajectoryPoint& point : trajectory.points()) {
    for (const Column& column : kColumns) {
      text += format_number(point.*column.value);
      text += &column == &kColumns.back() ? '\n' : ',';
    }
  }
  write_file_atomically(path, text);
}

}  // namespace nbvopt
