// How a command ends that was stopped between two pieces of its work.
#pragma once

#include <string>

namespace nbvopt {

/// Says what is left of the work, and ends the process as the signal does.
[[noreturn]] void end_by(int signal,
                         const std::string& left = "the same command goes on where it was");

}  // namespace nbvopt
