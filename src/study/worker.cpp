#include "study/worker.hpp"

#include <sys/prctl.h>
#include <tbb/global_control.h>

#include <chrono>
#include <csignal>
#include <optional>

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/version.hpp"
#include "study/line_channel.hpp"
#include "study/unit_runner.hpp"

namespace nbvopt::study {
namespace {

using Clock = std::chrono::steady_clock;

std::string answer_line(UnitRunner& runner, const std::string& line, Clock::time_point begin) {
  const WorkUnit unit = parse_work_unit(line);
  Json answer{{"unit", unit.id}};
  try {
    answer["answer"] = runner.run(unit);
  } catch (const std::exception& error) {
    answer["failure"] = error.what();
  }
  const std::chrono::duration<double, std::milli> busy = Clock::now() - begin;
  answer["busy_ms"] = busy.count();
  return answer.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

void run_worker(int in, int out, const SolverFactory& make) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  UnitRunner runner(make);
  LineReader lines(in);
  write_line(out, Json{{"protocol", kProtocolVersion}, {"nbvopt", version()}}.dump());
  while (const std::optional<std::string> line = lines.wait_for_line()) {
    write_line(out, answer_line(runner, *line, Clock::now()));
  }
}

}  // namespace nbvopt::study
