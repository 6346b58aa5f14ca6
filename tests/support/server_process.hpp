// nbvopt serve as a process of its own.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "support/background_process.hpp"

namespace nbvopt::test {

/// A server that is ready.
class ServerProcess {
 public:
  /// `program` is nbvopt or what runs it; its standard error, the log, goes to a file.
  ServerProcess(const std::string& program, const std::vector<std::string>& arguments,
                const std::string& log_file)
      : process_(program, arguments, log_file) {
    const std::string prefix = "listening on ";
    const std::string line = process_.read_line();
    if (!line.starts_with(prefix)) throw std::runtime_error("no server, see " + log_file);
    address_ = line.substr(prefix.size());
  }

  BackgroundProcess& process() { return process_; }
  const std::string& address() const { return address_; }

 private:
  BackgroundProcess process_;
  std::string address_;
};

}  // namespace nbvopt::test
