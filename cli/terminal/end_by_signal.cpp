#include "cli/terminal/end_by_signal.hpp"

#include <csignal>

#include "cli/terminal/output.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

void end_by(int signal, const std::string& left) {
  print_message("stopped; " + left);
  std::raise(signal);
  throw Error("stopped by a signal that this process ignores");
}

}  // namespace nbvopt
