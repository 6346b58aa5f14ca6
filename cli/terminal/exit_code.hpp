// How the tool ends.
#pragma once

namespace nbvopt {

/// The exit codes, as --help lists them.
enum class ExitCode : int {
  answered = 0,
  usage_error = 2,     ///< the command line itself is wrong
  input_error = 3,     ///< a file or a value cannot be used
  internal_error = 4,  ///< anything else
};

}  // namespace nbvopt
