// The evaluators by the names that users give them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nbvopt/gain/view_evaluator.hpp"

namespace nbvopt {

/// "exact", the default, and "paper-code".
std::vector<std::string> evaluator_names();

/// The sensor as the evaluator of that name wants it: the released code describes its own camera.
/// Throws UsageError that lists the names when `name` is not one of them.
SensorOptions evaluator_sensor(const std::string& name, const SensorOptions& sensor);

/// The evaluator of that name, on a grid of the map. Throws UsageError when the name is not known
/// or the evaluator cannot count as the sensor says. The map must outlive it and must not change.
/// "exact" looks at the hazards where the sensor's gain is expected.
std::unique_ptr<ViewEvaluator> make_evaluator(const std::string& name, const UncertaintyMap& map,
                                              std::shared_ptr<const VoxelGrid> grid,
                                              const SensorOptions& sensor,
                                              const HazardTable& hazards = HazardTable());

}  // namespace nbvopt
