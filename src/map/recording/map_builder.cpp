#include "map/recording/map_builder.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/input_file.hpp"
#include "core/number.hpp"
#include "map/point_records.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

/// The second line of a partial file: a comment for OctoMap, so that it is a map, too.
constexpr std::string_view kProgressComment = "# nbvopt map build ";

constexpr std::array kCounts{&BuildCounts::frames_inserted,   &BuildCounts::frames_none_in_range,
                             &BuildCounts::frames_unreadable, &BuildCounts::points_used,
                             &BuildCounts::points_too_near,   &BuildCounts::points_too_far,
                             &BuildCounts::no_returns,        &BuildCounts::points_not_finite,
                             &BuildCounts::points_off_lattice};

/// FNV-1a of all that is added, 64 bits.
class Fingerprint {
 public:
  void add(std::string_view text) {
    for (const char c : text) add_byte(static_cast<std::uint8_t>(c));
    add_byte(0);
  }
  void add(double number) { add(format_number(number)); }

  std::string text() const {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash_));
    return digits.data();
  }

 private:
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001B3U; }

  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

void add(const SensorOptions& sensor, Fingerprint& fingerprint) {
  for (const double number :
       {sensor.half_fov_horizontal_rad, sensor.half_fov_vertical_rad, sensor.range_min_m,
        sensor.range_max_m, sensor.focal_distance_m, sensor.uncertainty_half_fov_horizontal_rad,
        sensor.uncertainty_half_fov_vertical_rad, sensor.normal_weight}) {
    fingerprint.add(number);
  }
  fingerprint.add(to_string(sensor.uncertainty_mode));
  fingerprint.add(to_string(sensor.range_axis));
  fingerprint.add(to_string(sensor.no_return));
}

std::string fingerprint_of(const FrameSource& frames, const SensorOptions& sensor,
                           double resolution_m) {
  Fingerprint fingerprint;
  fingerprint.add(resolution_m);
  add(sensor, fingerprint);
  frames.identify([&](std::string_view text) { fingerprint.add(text); });
  return fingerprint.text();
}

/// The frames of a folder.
class FolderFrames : public FrameSource {
 public:
  explicit FolderFrames(Recording recording) : recording_(std::move(recording)) {}

  std::uint64_t frames() const override { return recording_.frames.size(); }
  PosedScan read(std::uint64_t frame) override {
    return read_frame(recording_, recording_.frames.at(frame));
  }
  std::string name(std::uint64_t frame) const override {
    return recording_.frames.at(frame).file.string();
  }
  void identify(const std::function<void(std::string_view)>& add) const override {
    const auto add_number = [&](double number) { add(format_number(number)); };
    if (const auto& image = recording_.depth_image) {
      for (const double number :
           {image->fx_px, image->fy_px, image->cx_px, image->cy_px, image->depth_scale_m}) {
        add_number(number);
      }
      add(to_string(image->largest_value));
    }
    add(to_string(recording_.axes));
    add(to_string(recording_.up));
    add(recording_.is_in_world_frame ? "world" : "frame");
    for (const RecordedFrame& frame : recording_.frames) {
      add(frame.file.filename().string());
      for (const double number : frame.T_world_frame.matrix().reshaped()) add_number(number);
    }
  }

 private:
  Recording recording_;
};

}  // namespace

std::unique_ptr<FrameSource> make_folder_frames(Recording recording) {
  return std::make_unique<FolderFrames>(std::move(recording));
}

MapBuilder::MapBuilder(std::unique_ptr<FrameSource> frames, const SensorOptions& sensor,
                       double resolution_m, fs::path partial_file)
    : frames_(std::move(frames)),
      sensor_(sensor),
      partial_file_(std::move(partial_file)),
      fingerprint_(fingerprint_of(*frames_, sensor, resolution_m)),
      map_(resolution_m) {
  sensor_.validate();
  if (fs::exists(partial_file_)) resume();
}

void MapBuilder::resume() {
  const std::string name = partial_file_.string();
  std::ifstream in = open_input_file(partial_file_);
  std::string line;
  std::getline(in, line);
  std::getline(in, line);
  const auto refuse = [&] {
    throw InputError(name +
                     ": is of another build (recording, poses or options differ), remove it "
                     "to start anew");
  };
  if (!line.starts_with(kProgressComment)) refuse();
  Words words(std::string_view(line).substr(kProgressComment.size()));
  if (words.next() != fingerprint_) refuse();
  const auto next_number = [&] {
    const auto number = parse_whole_number(words.next());
    if (!number) refuse();
    return number.value_or(0);
  };
  frames_done_ = next_number();
  if (frames_done_ > frames_->frames()) refuse();
  for (const auto count : kCounts) counts_.*count = next_number();
  in.seekg(0);
  map_ = read_map(in, name);
}

std::string MapBuilder::insert_next_frame() {
  const std::uint64_t frame = frames_done_++;
  try {
    const PosedScan posed = frames_->read(frame);
    if (const std::string doubt = none_in_range(count_scan(posed.scan, sensor_), sensor_);
        !doubt.empty()) {
      ++counts_.frames_none_in_range;
      return frames_->name(frame) + ": " + doubt;
    }
    const InsertResult result = insert_scan(map_, posed.scan, posed.T_map_sensor, sensor_);
    ++counts_.frames_inserted;
    counts_.points_used += result.points_used;
    counts_.points_too_near += result.points_too_near;
    counts_.points_too_far += result.points_too_far;
    counts_.no_returns += result.no_returns;
    counts_.points_not_finite += result.points_not_finite;
    counts_.points_off_lattice += result.points_off_lattice;
  } catch (const InputError& error) {
    ++counts_.frames_unreadable;
    return error.what();
  }
  return "";
}

void MapBuilder::save() const {
  std::string progress =
      std::string(kProgressComment) + fingerprint_ + ' ' + std::to_string(frames_done_);
  for (const auto count : kCounts) progress += ' ' + std::to_string(counts_.*count);
  std::string bytes = map_file_bytes(map_, MapFormat::uncertainty_ot);
  bytes.insert(bytes.find('\n') + 1, progress + '\n');
  write_file_atomically(partial_file_, bytes);
}

}  // namespace nbvopt
