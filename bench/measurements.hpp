// Everything that is measured on a scene.
#pragma once

#include <memory>
#include <vector>

#include "bench/bench_scene.hpp"
#include "bench/measurement.hpp"

namespace nbvopt::bench {

/// The gain of views by each evaluator and instruction set, on one core and on two; then queries.
void add_view_measurements(const std::shared_ptr<const BenchScene>& scene,
                           std::vector<Measurement>& measurements);

/// Reading the map, and the bricks that a query needs.
void add_map_measurements(const std::shared_ptr<const BenchScene>& scene,
                          std::vector<Measurement>& measurements);

/// Simulated scans of the office inserted one after the other, from an empty map on, by us and by
/// OctoMap.
void add_insertion_measurements(std::vector<Measurement>& measurements);

}  // namespace nbvopt::bench
