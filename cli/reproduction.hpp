// The paper's experiment, run by child processes that each do a part of it.
#pragma once

#include <cstddef>
#include <string>

#include "reproduction/paper_experiment.hpp"

namespace nbvopt {

struct ReproduceOptions {
  ExperimentOptions experiment;
  std::size_t jobs = 1;                    ///< processes at a time
  bool dry_run = false;                    ///< print the commands only
  std::string program = "/proc/self/exe";  ///< nbvopt: this very one, even if it is replaced
};

/// Runs the units that are not yet done and writes the tables from all that are. Throws InputError
/// or Error, after the tables are written, when a unit failed, as the unit's exit code tells; then
/// each has been reported on standard error. SIGINT and SIGTERM stop the units and end the process.
void reproduce(const ReproduceOptions& options);

}  // namespace nbvopt
