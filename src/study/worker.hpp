// A worker: reads units of work, answers them, one line each.
#pragma once

#include "study/unit_message.hpp"

namespace nbvopt::study {

/// Says hello, then answers every line of `in` by one on `out`, until `in` ends. What a unit throws
/// is its answer. Uses one thread. It is killed when its parent ends and heeds no SIGINT: that is
/// the coordinator's. Throws Error when a line is no unit or `out` cannot be written.
void run_worker(int in, int out, const SolverFactory& make = make_search_solver);

}  // namespace nbvopt::study
