// What mpirun tells the processes that it starts.
#pragma once

#include <array>
#include <cstdlib>

namespace nbvopt::experiment {

/// Whether mpirun, or a batch system in its place, has started this process beside others.
inline bool is_started_by_mpirun() {
  constexpr std::array<const char*, 2> kSizes{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
  for (const char* name : kSizes) {
    const char* size = std::getenv(name);
    if (size != nullptr && std::atoi(size) > 1) return true;
  }
  return false;
}

}  // namespace nbvopt::experiment
