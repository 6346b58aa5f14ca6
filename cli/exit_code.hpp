// How the tool ends.
#pragma once

namespace nbvopt {

/// The exit codes, as --help lists them.
enum ExitCode : int {
  kAnswered = 0,
  kUsageError = 2,     ///< the command line itself is wrong
  kInputError = 3,     ///< a file or a value cannot be used
  kInternalError = 4,  ///< anything else
};

}  // namespace nbvopt
