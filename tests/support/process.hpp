// Programs run as a shell would run them, their output kept.
#pragma once

#include <string>
#include <vector>

namespace nbvopt::test {

struct ProcessResult {
  int exit_code = -1;  ///< -1 when a signal ended it
  std::string out;
  std::string err;
};

/// Runs a program with these arguments, `input` on its standard input, and waits for its end.
ProcessResult run_process(const std::string& program, const std::vector<std::string>& arguments,
                          const std::string& input = {});

}  // namespace nbvopt::test
