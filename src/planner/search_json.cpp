#include "planner/search_json.hpp"

#include <cstddef>

namespace nbvopt {
namespace {

Json view_json(const JointPosition& joints, double gain) {
  return {{"pan", joints.pan_rad},
          {"tilt", joints.tilt_rad},
          {"height", joints.height_m},
          {"gain", gain}};
}

}  // namespace

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

Json to_json(const Landscape& landscape, const PlanResult& result,
             const std::vector<double>& candidate_pans_rad) {
  const JointPosition& start = result.request.joints;
  Json rows = Json::array();
  const auto columns = static_cast<std::ptrdiff_t>(landscape.pan_rad.size());
  for (auto row = landscape.gain.begin(); row != landscape.gain.end(); row += columns) {
    rows.push_back(std::vector<double>(row, row + columns));
  }
  Json candidates = Json::array();
  for (const double pan_rad : candidate_pans_rad) {
    candidates.push_back({{"pan", pan_rad}, {"tilt", start.tilt_rad}});
  }
  Json path = Json::array();
  for (const TracePoint& point : improvements(result.trace)) {
    path.push_back(view_json(point.joints, point.gain));
  }
  return {{"height", landscape.height_m},
          {"pan", landscape.pan_rad},
          {"tilt", landscape.tilt_rad},
          {"gain", rows},
          {"start", view_json(start, result.current.gain)},
          {"chosen", view_json(result.joints, result.view.gain)},
          {"candidates", candidates},
          {"path", path}};
}

}  // namespace nbvopt
