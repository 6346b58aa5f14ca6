#include "bench/run_benchmarks.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <iostream>

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

/// Prints the machine first and the report last.
class ReportPrinter : public benchmark::BenchmarkReporter {
 public:
  explicit ReportPrinter(const std::function<std::string()>& report) : report_(report) {}

  bool ReportContext(const Context& context) override {
    PrintBasicContext(&std::cerr, context);
    return true;
  }
  void ReportRuns(const std::vector<Run>&) override {}
  void Finalize() override { std::cout << report_() << std::flush; }

 private:
  const std::function<std::string()>& report_;
};

}  // namespace

int run_benchmarks(int argc, char** argv, const BenchmarkRun& benchmarks) {
  // Flags given later win over these.
  std::string repetitions = "--benchmark_repetitions=" + std::to_string(benchmarks.repetitions);
  std::string random_order = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> arguments{argv[0], repetitions.data(), random_order.data()};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;

  for (Measurement* measurement : benchmarks.measurements) {
    benchmark::RegisterBenchmark((measurement->scene + ": " + measurement->name).c_str(),
                                 [measurement](benchmark::State& s) { run(s, *measurement); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
  ReportPrinter printer(benchmarks.report);
  benchmark::RunSpecifiedBenchmarks(&printer);
  return 0;
}

}  // namespace nbvopt::bench
