// nbvopt_bench_search: what searches find, and how soon, on one core.
//
// --json FILE writes every query's answer to a file. All other flags are Google Benchmark's:
// --benchmark_repetitions=1 is quick, --benchmark_filter=REGEX measures less.
#include <iostream>
#include <optional>

#include "bench/against_grids.hpp"
#include "bench/hard_cases.hpp"
#include "bench/run_benchmarks.hpp"
#include "bench/search_report.hpp"
#include "core/atomic_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::bench {
namespace {

/// The value of "--json FILE", which is taken out of the arguments; none where it is not given.
std::optional<std::string> take_json_file(std::vector<char*>& arguments) {
  for (auto it = arguments.begin(); it != arguments.end(); ++it) {
    if (std::string(*it) != "--json") continue;
    if (std::next(it) == arguments.end()) throw UsageError("--json: name the file to write");
    const std::string file = *std::next(it);
    arguments.erase(it, it + 2);
    return file;
  }
  return std::nullopt;
}

int run_all(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  const std::optional<std::string> json_file = take_json_file(arguments);
  if (json_file) require_writable(*json_file);

  std::vector<SearchMeasurements> maps;
  for (const auto& scene : make_bench_scenes({"ASLAM_lab", "apartment_partial"})) {
    maps.push_back(measure_searches(scene));
  }
  BenchmarkRun benchmarks{.repetitions = 10, .report = [&maps] {
                            return to_table(maps) + '\n' + compare_with_grids(maps);
                          }};
  for (const SearchMeasurements& measurements : maps) {
    for (const auto& m : measurements) benchmarks.measurements.push_back(&m->measurement);
  }
  const int exit_code =
      run_benchmarks(static_cast<int>(arguments.size()), arguments.data(), benchmarks);
  if (exit_code == 0) std::cout << '\n' << measure_hard_cases();
  if (exit_code == 0 && json_file) write_file_atomically(*json_file, to_json_lines(maps));
  return exit_code;
}

}  // namespace
}  // namespace nbvopt::bench

int main(int argc, char** argv) {
  try {
    return nbvopt::bench::run_all(argc, argv);
  } catch (const nbvopt::Error& error) {
    std::cerr << "nbvopt_bench_search: " << error.what() << '\n';
    return 2;
  }
}
