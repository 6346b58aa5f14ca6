// nbvopt serve as a process of its own.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "support/background_process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::bench {

/// A server that is ready, on a free port of the loopback address.
class ServerProcess {
 public:
  explicit ServerProcess(std::vector<std::string> arguments)
      : process_(NBVOPT_CLI, with_address(std::move(arguments)), folder_ / "log") {
    const std::string prefix = "listening on ";
    const std::string line = process_.read_line();
    if (!line.starts_with(prefix)) throw std::runtime_error("the server did not start");
    address_ = line.substr(prefix.size());
  }

  const std::string& address() const { return address_; }
  const test::BackgroundProcess& process() const { return process_; }

 private:
  static std::vector<std::string> with_address(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "serve");
    arguments.insert(arguments.end(), {"--listen", "127.0.0.1:0"});
    return arguments;
  }

  test::TemporaryFolder folder_;
  test::BackgroundProcess process_;
  std::string address_;
};

}  // namespace nbvopt::bench
