// A program that runs beside the test.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace nbvopt::test {

/// Killed, if need be, when this goes.
class BackgroundProcess {
 public:
  /// Starts the program; its standard error goes to `error_file`.
  BackgroundProcess(const std::string& program, const std::vector<std::string>& arguments,
                    const std::string& error_file);
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;
  ~BackgroundProcess();

  /// The next line of its standard output, waited for; empty when there is none any more.
  std::string read_line();

  pid_t id() const { return pid_; }
  void send(int signal) const;

  /// Whether it is over; wait() tells how.
  bool has_ended() const;

  /// Waits for its end; the exit code, -1 when a signal ended it.
  int wait();

 private:
  pid_t pid_ = -1;
  int out_ = -1;
};

}  // namespace nbvopt::test
