// nbvopt_bench: the evaluators, the grids that they cast on, reading maps and inserting scans.
//
// The flags are Google Benchmark's: --benchmark_repetitions=2 is quick, --benchmark_filter=REGEX
// measures less, --benchmark_out=FILE keeps every repetition for tools/compare.py.
#include "bench/measurements.hpp"
#include "bench/run_benchmarks.hpp"
#include "bench/table.hpp"

namespace nbvopt::bench {
namespace {

std::vector<Measurement> all_measurements() {
  std::vector<Measurement> measurements;
  for (const auto& scene : make_bench_scenes({"ASLAM_lab"})) {
    add_view_measurements(scene, measurements);
    add_map_measurements(scene, measurements);
  }
  add_insertion_measurements(measurements);
  return measurements;
}

int run_all(int argc, char** argv) {
  std::vector<Measurement> measurements = all_measurements();
  BenchmarkRun benchmarks{.report = [&measurements] { return to_table(measurements); }};
  for (Measurement& measurement : measurements) benchmarks.measurements.push_back(&measurement);
  return run_benchmarks(argc, argv, benchmarks);
}

}  // namespace
}  // namespace nbvopt::bench

int main(int argc, char** argv) { return nbvopt::bench::run_all(argc, argv); }
