// Builds a map from a recording, frame by frame, and goes on where an earlier build was stopped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "map/recording/frame_source.hpp"
#include "nbvopt/map/recording.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// What became of the frames of a recording, and of the points of those that were inserted.
struct BuildCounts {
  std::uint64_t frames_inserted = 0;
  std::uint64_t frames_none_in_range = 0;  ///< left out: they could only clear
  std::uint64_t frames_unreadable = 0;     ///< left out
  std::uint64_t points_used = 0;
  std::uint64_t points_too_near = 0;
  std::uint64_t points_too_far = 0;
  std::uint64_t no_returns = 0;
  std::uint64_t points_not_finite = 0;
  std::uint64_t points_off_lattice = 0;

  bool operator==(const BuildCounts&) const = default;
};

/// Memory is that of the map and of one frame, besides a list of the frames.
class MapBuilder {
 public:
  /// Goes on from `partial_file` when it is there and holds a part of this very build, all of it
  /// told by the frames, their poses and all options. Throws InputError when it holds one of
  /// another, or when an option is bad.
  MapBuilder(std::unique_ptr<FrameSource> frames, const SensorOptions& sensor, double resolution_m,
             std::filesystem::path partial_file);

  std::uint64_t frames_done() const { return frames_done_; }
  bool is_done() const { return frames_done_ == frames_->frames(); }

  /// Inserts the next frame. What was wrong with one that is left out, naming it; else nothing.
  std::string insert_next_frame();

  /// Writes map, counts and place to the partial file, whole or not at all.
  void save() const;

  const UncertaintyMap& map() const { return map_; }
  const BuildCounts& counts() const { return counts_; }

 private:
  void resume();

  std::unique_ptr<FrameSource> frames_;
  SensorOptions sensor_;
  std::filesystem::path partial_file_;
  std::string fingerprint_;
  UncertaintyMap map_;
  BuildCounts counts_;
  std::uint64_t frames_done_ = 0;
};

}  // namespace nbvopt
