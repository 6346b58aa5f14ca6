// All measurements in one process, in random order and repeated, so that what else the machine does
// meets all of them alike.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/measurement.hpp"

namespace nbvopt::bench {

struct BenchmarkRun {
  std::vector<Measurement*> measurements{};  ///< outlive the run
  int repetitions = 20;                      ///< unless a flag says otherwise
  std::function<std::string()> report{};     ///< what to print in the end
};

/// Runs all that the flags, which are Google Benchmark's, do not filter out: the machine is printed
/// to standard error first, the report to standard output last. Returns the exit code.
int run_benchmarks(int argc, char** argv, const BenchmarkRun& benchmarks);

}  // namespace nbvopt::bench
