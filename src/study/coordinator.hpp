// Hands units of work to workers, which are processes: one that hangs can be stopped.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/unit_message.hpp"

namespace nbvopt::study {

struct CoordinatorOptions {
  std::vector<std::string> worker_command;  ///< a program that speaks the protocol, its arguments
  std::size_t workers = 1;
  double timeout_s = 60.0;  ///< a unit that takes longer has failed
};

/// How a unit ended.
struct WorkOutcome {
  Json answer;           ///< null when it failed
  std::string failure;   ///< why; empty otherwise
  double busy_ms = 0.0;  ///< that it took; 0 where its worker ended
};

/// How all of them ended.
struct CoordinatorResult {
  std::size_t finished = 0;       ///< units, failed ones included
  std::size_t failed = 0;         ///< of these
  std::optional<int> stopped_by;  ///< SIGINT or SIGTERM; none: all units have ended
  double wall_ms = 0.0;
  double busy_ms = 0.0;  ///< that workers spent on units, summed
};

/// Runs `count` units, in about their order, on processes that are started here. A unit fails when
/// its worker says so, does not answer in time, or ends twice with it. On SIGINT and SIGTERM no
/// unit is handed out any more and those at work are waited for; on a second one they are dropped.
/// `on_end` is told of every unit that has ended.
///
/// To be called by a process's only thread, or with both signals blocked in all others. Throws
/// InputError when a worker cannot be started, and what `on_end` throws; then nothing is left
/// running.
CoordinatorResult run_units(
    std::size_t count, const std::function<WorkUnit(std::size_t index)>& unit_at,
    const CoordinatorOptions& options,
    const std::function<void(std::size_t index, const WorkOutcome& outcome)>& on_end);

}  // namespace nbvopt::study
