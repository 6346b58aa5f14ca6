#include "planner/trace.hpp"

#include "core/json.hpp"

namespace nbvopt {

std::string to_json_lines(const std::vector<TracePoint>& trace) {
  std::string lines;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const TracePoint& point = trace[i];
    const Json object{{"evaluation", i + 1},
                      {"kind", to_string(point.kind)},
                      {"pan", point.joints.pan_rad},
                      {"tilt", point.joints.tilt_rad},
                      {"height", point.joints.height_m},
                      {"gain", point.gain},
                      {"best_gain", point.best_gain},
                      {"time_ms", point.time_ms}};
    lines += object.dump() + '\n';
  }
  return lines;
}

}  // namespace nbvopt
