// What drives and episodes leave behind, for programs and for people.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/exploration.hpp"

namespace nbvopt {

/// Mean milliseconds a capture.
struct StepTimes {
  double render_ms = 0.0;
  double insert_ms = 0.0;
  double grid_ms = 0.0;
  double plan_ms = 0.0;
};

/// Adds up the times of captures.
class StepTimer {
 public:
  void add(const Capture& capture);
  StepTimes mean() const;

 private:
  StepTimes sum_;
  std::uint64_t captures_ = 0;
};

/// All of a drive with the camera off that is worth telling.
struct DriveReport {
  std::string world = {};
  std::vector<double> start = {};  ///< as DriveOptions::start
  ExplorationStatus status = ExplorationStatus::complete;
  double duration_s = 0.0;
  double length_m = 0.0;
  std::uint64_t seed = 0;
};

/// All of an episode that is worth telling.
struct EpisodeReport {
  std::string world;
  std::string mode;
  double motion_time_s = 0.0;
  std::uint64_t seed = 0;
  EpisodeSummary summary;
  PaperCounts paper_counts;
  StepTimes times;
  double elapsed_ms = 0.0;  ///< of the whole episode
  /// How the drive ended that was made for it; none: it was replayed.
  std::optional<ExplorationStatus> drive_status = {};
  PoseSource pose_source = PoseSource::truth;
};

/// JSON has no NaN: what does not exist is null.
Json number_or_null(double value);

Json to_json(const Capture& capture);
Json to_json(const DriveReport& report);
Json to_json(const EpisodeReport& report);
std::string to_text(const DriveReport& report);
std::string to_text(const EpisodeReport& report);

/// The way back; other keys are passed over. Throw nlohmann's exceptions, and InputError for a
/// status or pose source that is not known.
DriveReport drive_report_of(const Json& json);
EpisodeReport episode_report_of(const Json& json);

/// Writes a JSON object a line while the episode runs. Throws InputError that names the file when
/// it cannot be written.
class CaptureLog {
 public:
  explicit CaptureLog(const std::string& path);
  void add(const Capture& capture);

 private:
  std::string path_;
  std::ofstream out_;
};

}  // namespace nbvopt
