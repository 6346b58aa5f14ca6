// Small studies on a small map.
#pragma once

#include <string>

#include "nbvopt/map/map_file.hpp"
#include "study/spec/spec_file.hpp"
#include "support/made_map.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {

/// A folder with a map, cluttered.ot: 4 x 4 x 1.5 m of free space with some clutter, voxels of
/// 0.1 m.
class StudyFiles {
 public:
  StudyFiles() { write_map_file("cluttered.ot", 1); }

  void write_map_file(const std::string& name, std::uint64_t seed, double clutter = 0.02) const {
    UncertaintyMap map(0.1);
    std::mt19937_64 random(seed);
    scatter(map, keys_between(map.lattice(), {-2.0, -2.0, 0.0}, {2.0, 2.0, 1.5}), clutter, random);
    map.finish_writing();
    write_map(map, folder / name, MapFormat::uncertainty_ot);
  }

  std::string write_spec(const std::string& text) const { return folder.write("spec.yaml", text); }

  study::Study read(const std::string& text) const {
    return study::read_spec(write_spec(text)).study;
  }

  const TemporaryFolder folder;
};

/// Three starts, two searches besides the paper's four, two budgets: 36 units of milliseconds.
inline constexpr const char* kSmallSpec =
    "maps: [cluttered.ot]\n"
    "starts: {sampled: {count: 3, seed: 7}}\n"
    "motion_times_s: [0.5]\n"
    "solvers:\n"
    "  - solver: auto\n"
    "  - solver: random\n"
    "budgets: {max_evaluations: [20, 60]}\n";

}  // namespace nbvopt::test
