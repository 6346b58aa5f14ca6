#include "experiment/worker.hpp"

#include <sys/prctl.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <string>

#include "core/stopwatch.hpp"
#include "experiment/line_channel.hpp"
#include "experiment/protocol.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {
namespace {

Outcome outcome_of(const Json& payload, const Answer& answer) {
  try {
    return {.answer = answer(payload)};
  } catch (const std::exception& error) {
    // Nobody would take an empty one for a failure.
    const std::string why = error.what();
    return {.answer = Json(), .failure = why.empty() ? "no reason was given" : why};
  }
}

std::string reply_to(const std::string& line, const Answer& answer) {
  const Stopwatch stopwatch;
  const Unit unit = parse_unit(line);
  Outcome outcome = outcome_of(unit.payload, answer);
  outcome.busy_ms = stopwatch.elapsed_ms();
  return answer_line(unit.id, outcome);
}

}  // namespace

void run_worker(int in, int out, const Answer& answer) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  LineReader lines(in);
  write_line(out, hello_line());
  while (const std::optional<std::string> line = lines.wait_for_line()) {
    write_line(out, reply_to(*line, answer));
  }
}

void run_worker(const Answer& answer) {
  const int out = ::dup(STDOUT_FILENO);
  if (out < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    throw Error("the worker's standard output cannot be set aside");
  }
  run_worker(STDIN_FILENO, out, answer);
}

}  // namespace nbvopt::experiment
