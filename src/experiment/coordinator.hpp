// Hands units of work to workers and keeps a record of each that has ended.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "experiment/pool.hpp"
#include "experiment/record_file.hpp"
#include "experiment/work.hpp"

namespace nbvopt::experiment {

/// How all of them ended.
struct RunResult {
  std::size_t finished = 0;       ///< units, failed ones included
  std::size_t failed = 0;         ///< of these
  std::optional<int> stopped_by;  ///< SIGINT or SIGTERM; none: all have ended that could be run
  double wall_ms = 0.0;
  double busy_ms = 0.0;  ///< that workers spent on units, summed
};

/// Runs the units `to_do`, ascending, in about their order; one whose predecessor is among them
/// waits for its success, and is not run when that fails. A unit fails when its worker says so,
/// does not answer in time, or ends twice with it. Every record is in its file before the next, and
/// before a unit that waits for it is handed out; then `on_record` is told of it. Where units are
/// short, a worker gets several at a time, a tenth of a second's at most as far as those before
/// tell. On SIGINT and SIGTERM no unit is handed out any more and those that were are waited for;
/// on a second one they are dropped; `on_stop`, if there is one, is told how many are waited for.
///
/// To be called by a process's only thread, or with both signals blocked in all others; the pool
/// must be new. Throws InputError when a worker cannot be started or a record not be written, and
/// what `on_record` and `on_stop` throw.
RunResult run_units(Work& work, std::span<const std::size_t> to_do, double timeout_s, Pool& pool,
                    RecordFile& records, const std::function<void(const Json& record)>& on_record,
                    const std::function<void(std::size_t units)>& on_stop = {});

}  // namespace nbvopt::experiment
