// What a process takes.
#pragma once

#include <sys/types.h>

#include <fstream>
#include <string>

namespace nbvopt::bench {

/// The memory of a process that is in use, MB.
inline double resident_mb(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == "VmRSS:" && status >> kilobytes) return kilobytes / 1024.0;
  }
  return 0.0;
}

}  // namespace nbvopt::bench
