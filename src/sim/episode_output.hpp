// What an episode leaves behind, for programs and for people.
#pragma once

#include <fstream>
#include <string>

#include "core/json.hpp"
#include "nbvopt/sim/episode.hpp"

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
};

Json to_json(const Capture& capture);
Json to_json(const EpisodeReport& report);
std::string to_text(const EpisodeReport& report);

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
