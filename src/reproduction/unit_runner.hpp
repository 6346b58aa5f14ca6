// Answers units of work: what a worker of the reproduction does between two lines.
#pragma once

#include <memory>
#include <string>

#include "reproduction/simulation_unit.hpp"

namespace nbvopt {

struct KeptWorld;

/// Keeps the world of the last unit: units that follow one another share it.
class UnitRunner {
 public:
  UnitRunner();
  ~UnitRunner();

  /// Simulates: a drive records its trajectory in its file first. The answer is the record of the
  /// drive, with what the world's reader warned of, or of the episode; either with the digest of
  /// the trajectory's file. Everything outside
  /// "times_ms" is the same whenever the same unit is run. Throws InputError when the world is not
  /// what it was when it was read for the unit, and what the simulation throws.
  Json run(const SimulationUnit& unit);

 private:
  const KeptWorld& world(const WorldSource& source);

  std::filesystem::path world_file_;
  std::string world_digest_;
  std::unique_ptr<const KeptWorld> world_;
};

}  // namespace nbvopt
