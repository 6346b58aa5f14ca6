// Answers units of work: what a worker does between two lines.
#pragma once

#include <filesystem>
#include <memory>

#include "study/unit_message.hpp"

namespace nbvopt::study {

/// Keeps the map and the robot of the last unit: units that follow one another share them.
class UnitRunner {
 public:
  explicit UnitRunner(SolverFactory make);
  ~UnitRunner();

  /// The answer, as docs/guide/studies.md describes it. Everything outside its "times" is the same
  /// whenever the same unit is run, unless a time limit bounds it. Throws what planning throws, and
  /// InputError when the map's content is not what the unit says.
  Json run(const WorkUnit& unit);

 private:
  class Scene;

  Json run_query(const WorkUnit& unit);
  Json run_reference(const WorkUnit& unit);

  SolverFactory make_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace nbvopt::study
