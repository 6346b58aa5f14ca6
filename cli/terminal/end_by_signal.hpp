// How a command ends that was stopped between two pieces of its work.
#pragma once

namespace nbvopt {

/// Says that the same command goes on where this one was, and ends the process as the signal does.
[[noreturn]] void end_by(int signal);

}  // namespace nbvopt
