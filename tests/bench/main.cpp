// nbvopt_bench: all measurements in one process, in random order and repeated, so that what else
// the machine does meets all of them alike; then their table.
//
// The flags are Google Benchmark's: --benchmark_repetitions=2 is quick, --benchmark_filter=REGEX
// measures less, --benchmark_out=FILE keeps every repetition for tools/compare.py.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "bench/measurements.hpp"
#include "bench/table.hpp"

namespace nbvopt::bench {
namespace {

void run(benchmark::State& state, Measurement& measurement) {
  for ([[maybe_unused]] auto iteration : state) {
    double sum_s = 0.0;
    for (std::size_t i = 0; i < measurement.items; ++i) {
      const double item_s = measurement.run(i);
      measurement.best_s[i] = std::min(measurement.best_s[i], item_s);
      sum_s += item_s;
    }
    state.SetIterationTime(sum_s);
  }
  if (measurement.rays_an_item > 0.0) {
    state.counters["rays_per_second"] =
        benchmark::Counter(measurement.rays_an_item * static_cast<double>(measurement.items),
                           benchmark::Counter::kIsIterationInvariantRate);
  }
}

/// Prints the machine first and the table last.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  explicit TableReporter(const std::vector<Measurement>& measurements)
      : measurements_(measurements) {}

  bool ReportContext(const Context& context) override {
    PrintBasicContext(&std::cerr, context);
    return true;
  }
  void ReportRuns(const std::vector<Run>&) override {}
  void Finalize() override { std::cout << to_table(measurements_); }

 private:
  const std::vector<Measurement>& measurements_;
};

std::vector<Measurement> all_measurements() {
  std::vector<Measurement> measurements;
  for (const auto& scene : make_bench_scenes()) {
    add_view_measurements(scene, measurements);
    add_map_measurements(scene, measurements);
  }
  add_insertion_measurements(measurements);
  return measurements;
}

int run_all(int argc, char** argv) {
  // Flags given later win over these.
  std::string repetitions = "--benchmark_repetitions=20";
  std::string random_order = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments{argv[0], repetitions.data(), random_order.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  std::vector<Measurement> measurements = all_measurements();
  for (Measurement& measurement : measurements) {
    benchmark::RegisterBenchmark((measurement.scene + ": " + measurement.name).c_str(),
                                 [&measurement](benchmark::State& s) { run(s, measurement); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
  TableReporter reporter(measurements);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}

}  // namespace
}  // namespace nbvopt::bench

int main(int argc, char** argv) { return nbvopt::bench::run_all(argc, argv); }
