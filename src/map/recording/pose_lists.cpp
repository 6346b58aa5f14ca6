#include "map/recording/pose_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>

#include "map/point_records.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr std::string_view kSeparators = " \t\r,";

/// Calls `visit(line, words)` for each line that holds more than a comment, without its comment.
template <class Visit>
void for_each_line(const std::string& text, const std::string& name, const Visit& visit) {
  std::istringstream in(text);
  ScanInput lines(in, name);
  while (auto line = lines.next_line()) {
    line->erase(std::min(line->find('#'), line->size()));
    Words words(*line, kSeparators);
    const std::vector<std::string> list = words.rest();
    if (!list.empty()) visit(lines, list);
  }
}

std::vector<double> numbers_of(std::span<const std::string> words, const ScanInput& lines) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    const auto number = parse_scan_number(word);
    if (!number) {
      lines.refuse_line("'" + word.substr(0, 40) + "' stands where a number was expected");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

bool is_finite(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
}

/// 12 or 16 numbers, row by row. The rotation is made one to the last digit, since files round.
std::optional<Transform> transform_of(std::span<const double> numbers, const ScanInput& lines) {
  if (!is_finite(numbers)) return std::nullopt;
  const Eigen::Matrix<double, 3, 4> top =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
  const Eigen::Matrix3d R = top.leftCols<3>();
  constexpr double kMostError = 0.01;
  const bool is_rotation =
      (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kMostError &&
      R.determinant() > 0.0;
  if (!is_rotation) {
    lines.refuse_line(
        "the matrix that ends here is no rigid transform: its first three columns "
        "are no rotation");
  }
  Transform T = Transform::Identity();
  T.translate(top.col(3));
  T.rotate(Eigen::Quaterniond(R).normalized());
  return T;
}

KeyedPose keyed_pose(const std::vector<std::string>& words, const ScanInput& lines) {
  constexpr std::size_t kPosition = 4;
  constexpr std::size_t kPose = 8;
  if (words.size() != kPose && words.size() != kPosition) {
    lines.refuse_line("a pose is 'name or time x y z qx qy qz qw', this line has " +
                      std::to_string(words.size()) + " words");
  }
  KeyedPose pose{.key = words.front(), .has_orientation = words.size() == kPose};
  std::vector<double> n = numbers_of(std::span(words).subspan(1), lines);
  if (!pose.has_orientation) n.insert(n.end(), {0.0, 0.0, 0.0, 1.0});
  try {
    pose.T_world_frame = pose_from_quaternion({n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]});
  } catch (const InputError& error) {
    lines.refuse_line(error.what());
  }
  return pose;
}

}  // namespace

std::vector<KeyedPose> parse_keyed_poses(const std::string& text, const std::string& name) {
  std::vector<KeyedPose> poses;
  for_each_line(text, name, [&](const ScanInput& lines, const std::vector<std::string>& words) {
    poses.push_back(keyed_pose(words, lines));
  });
  return poses;
}

std::optional<Transform> parse_pose_matrix(const std::string& text, const std::string& name) {
  std::vector<double> numbers;
  std::optional<Transform> T;
  for_each_line(text, name, [&](const ScanInput& lines, const std::vector<std::string>& words) {
    const std::vector<double> row = numbers_of(words, lines);
    numbers.insert(numbers.end(), row.begin(), row.end());
    if (numbers.size() == 12 || numbers.size() == 16) T = transform_of(numbers, lines);
  });
  if (numbers.size() == 12 || numbers.size() == 16) return T;
  throw InputError(name + ": a pose is a matrix of 4 x 4 or 3 x 4 numbers, here are " +
                   std::to_string(numbers.size()));
}

std::vector<std::optional<Transform>> parse_matrix_lines(const std::string& text,
                                                         const std::string& name) {
  std::vector<std::optional<Transform>> poses;
  for_each_line(text, name, [&](const ScanInput& lines, const std::vector<std::string>& words) {
    if (words.size() != 12 && words.size() != 16) {
      lines.refuse_line("a pose is a matrix of 12 or 16 numbers, here are " +
                        std::to_string(words.size()));
    }
    poses.push_back(transform_of(numbers_of(words, lines), lines));
  });
  return poses;
}

std::vector<NumberedPose> parse_trajectory_log(const std::string& text, const std::string& name) {
  constexpr std::size_t kHeader = 3;
  constexpr std::size_t kNumbers = kHeader + 16;
  constexpr double kMostFrames = 1e9;
  std::vector<NumberedPose> poses;
  std::vector<double> numbers;
  for_each_line(text, name, [&](const ScanInput& lines, const std::vector<std::string>& words) {
    const std::vector<double> row = numbers_of(words, lines);
    numbers.insert(numbers.end(), row.begin(), row.end());
    if (numbers.size() < kNumbers) return;
    if (numbers.size() > kNumbers || !(numbers[0] >= 0.0 && numbers[0] < kMostFrames)) {
      lines.refuse_line("three numbers and a 4 x 4 matrix were expected up to here");
    }
    poses.push_back({static_cast<std::uint64_t>(numbers[0]),
                     transform_of(std::span(numbers).subspan(kHeader), lines)});
    numbers.clear();
  });
  if (!numbers.empty()) throw InputError(name + ": the last matrix is not complete");
  return poses;
}

Transform parse_calibration(const std::string& text, const std::string& key,
                            const std::string& name) {
  std::optional<Transform> T;
  for_each_line(text, name, [&](const ScanInput& lines, const std::vector<std::string>& words) {
    if (words.front() != key + ":" || T) return;
    const std::vector<double> numbers = numbers_of(std::span(words).subspan(1), lines);
    if (numbers.size() != 12) lines.refuse_line("12 numbers were expected");
    T = transform_of(numbers, lines);
  });
  if (!T) throw InputError(name + ": there is no line '" + key + ": ' with a 3 x 4 matrix");
  return *T;
}

std::array<double, 4> parse_camera_matrix(const std::string& text, const std::string& name) {
  std::vector<double> n;
  for_each_line(text, name, [&](const ScanInput& lines, const std::vector<std::string>& words) {
    const std::vector<double> row = numbers_of(words, lines);
    n.insert(n.end(), row.begin(), row.end());
  });
  if (n.size() == 16) return {n[0], n[5], n[2], n[6]};
  if (n.size() == 9) return {n[0], n[4], n[2], n[5]};
  throw InputError(name + ": a camera is a matrix of 3 x 3 or 4 x 4 numbers, here are " +
                   std::to_string(n.size()));
}

TimedPoses::TimedPoses(const std::vector<KeyedPose>& poses, const std::string& name) {
  for (const KeyedPose& pose : poses) {
    const auto time_s = parse_scan_number(pose.key);
    if (!time_s || !std::isfinite(*time_s)) {
      throw InputError(name + ": '" + pose.key + "' is no time");
    }
    by_time_.push_back({*time_s, &pose});
  }
  std::ranges::stable_sort(by_time_, {}, &Entry::time_s);
}

const KeyedPose* TimedPoses::nearest(double time_s, double max_difference_s) const {
  const auto after = std::ranges::lower_bound(by_time_, time_s, {}, &Entry::time_s);
  const Entry* best = nullptr;
  if (after != by_time_.begin()) best = &*std::prev(after);
  if (after != by_time_.end() &&
      (best == nullptr || after->time_s - time_s < time_s - best->time_s)) {
    best = &*after;
  }
  if (best == nullptr || !(std::abs(best->time_s - time_s) <= max_difference_s)) return nullptr;
  return best->pose;
}

}  // namespace nbvopt
