// A worker: reads units of work, answers them, one line each.
#pragma once

#include <functional>

#include "core/json.hpp"

namespace nbvopt::experiment {

/// What a worker does between two lines: the answer, an object, to a unit's payload.
using Answer = std::function<Json(const Json& payload)>;

/// Says hello, then answers every line of `in` by one on `out`, until `in` ends. What a unit throws
/// is its failure. Uses one thread. It is killed when its parent ends and heeds no SIGINT: that is
/// the coordinator's. Throws Error when a line is no unit or `out` cannot be written.
void run_worker(int in, int out, const Answer& answer);

/// The same on standard input and output. What else is printed there meanwhile goes to standard
/// error: a library that prints must not get between the lines.
void run_worker(const Answer& answer);

}  // namespace nbvopt::experiment
