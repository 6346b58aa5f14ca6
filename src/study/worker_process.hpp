// A worker as its coordinator sees it: a process with a line in and a line out.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "core/descriptor.hpp"
#include "study/line_channel.hpp"

namespace nbvopt::study {

/// Killed, if need be, when this goes.
class WorkerProcess {
 public:
  /// Starts the command, a program and its arguments, in a process group of its own, so that a
  /// terminal's Ctrl-C reaches the coordinator alone. Throws InputError when it cannot be started.
  WorkerProcess(const std::vector<std::string>& command, const sigset_t& signals);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess();

  /// Readable when it has written, or ended.
  int descriptor() const { return from_.get(); }
  LineReader& lines() { return lines_; }

  /// False when it has ended.
  bool send(const std::string& line);

  void kill() const { ::kill(pid_, SIGKILL); }

  /// Waits for the end of a process that has closed its line out or was killed; says how it ended.
  std::string wait_for_end();

 private:
  pid_t pid_ = -1;
  Descriptor to_{-1};
  Descriptor from_{-1};
  LineReader lines_{-1};
  bool has_ended_ = false;
};

}  // namespace nbvopt::study
