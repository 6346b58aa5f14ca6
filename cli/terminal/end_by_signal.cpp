#include "cli/terminal/end_by_signal.hpp"

#include <csignal>

#include "cli/terminal/output.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

void end_by(int signal) {
  print_message("stopped; the same command goes on where it was");
  std::raise(signal);
  throw Error("stopped by a signal that this process ignores");
}

}  // namespace nbvopt
