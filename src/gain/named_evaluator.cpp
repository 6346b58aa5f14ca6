#include "nbvopt/gain/named_evaluator.hpp"

#include <utility>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr const char* kExact = "exact";
constexpr const char* kPaperCode = "paper-code";

bool is_paper_code(const std::string& name) {
  if (name != kExact && name != kPaperCode) {
    throw UsageError("evaluator '" + name + "' is not known, use " + kExact + " or " + kPaperCode);
  }
  return name == kPaperCode;
}

}  // namespace

std::vector<std::string> evaluator_names() { return {kExact, kPaperCode}; }

SensorOptions evaluator_sensor(const std::string& name, const SensorOptions& sensor) {
  return is_paper_code(name) ? paper_code_sensor(sensor) : sensor;
}

std::unique_ptr<ViewEvaluator> make_evaluator(const std::string& name, const UncertaintyMap& map,
                                              std::shared_ptr<const VoxelGrid> grid,
                                              const SensorOptions& sensor,
                                              const HazardTable& hazards) {
  if (!is_paper_code(name)) {
    return make_exact_evaluator(std::move(grid), DepthCamera(sensor), hazards);
  }
  if (sensor.gain != GainKind::positive) {
    throw UsageError("the paper-code evaluator has no gain " + to_string(sensor.gain) +
                     ", use the evaluator exact");
  }
  if (sensor.counting == Counting::per_voxel) {
    throw UsageError("the paper-code evaluator counts per_ray only, use the evaluator exact");
  }
  if (sensor.normal_weight > 0.0) {
    throw UsageError("the paper-code evaluator knows no normals, use the evaluator exact");
  }
  return make_paper_code_evaluator(map, sensor);
}

}  // namespace nbvopt
