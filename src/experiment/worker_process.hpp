// A worker as its coordinator sees it: a process with a line in and a line out.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "core/descriptor.hpp"
#include "experiment/line_channel.hpp"

namespace nbvopt::experiment {

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

  /// One that has ended does not get the line; its line out has then ended, too.
  void send(const std::string& line);

  /// Kills it and what it has started, unless it has ended by itself; says how it ended.
  std::string end();

 private:
  pid_t pid_ = -1;
  Descriptor to_{-1};
  Descriptor from_{-1};
  LineReader lines_{-1};
  bool has_ended_ = false;
};

}  // namespace nbvopt::experiment
