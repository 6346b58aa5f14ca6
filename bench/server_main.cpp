// nbvopt_bench_server: what a planning server takes, and what it stands.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <exception>
#include <iostream>

#include "bench/server_latency.hpp"
#include "bench/server_load.hpp"
#include "bench/server_soak.hpp"

int main(int argc, char** argv) {
  CLI::App app("Measures nbvopt serve.", "nbvopt_bench_server");
  int calls = 2000;
  double minutes = 10.0;
  app.add_option("--calls", calls, "plans whose latency is measured")->capture_default_str();
  app.add_option("--minutes", minutes, "of scans and plans side by side")->capture_default_str();
  double soak_minutes = 0.0;
  std::uint64_t seed = 1;
  app.add_option("--soak", soak_minutes,
                 "minutes of a robot's week with all that goes wrong, instead of the above");
  app.add_option("--seed", seed, "of the soak")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    if (soak_minutes > 0.0) {
      std::cout << nbvopt::bench::soak_server(soak_minutes, seed);
      return 0;
    }
    std::cout << nbvopt::bench::measure_server_latency(calls)
              << nbvopt::bench::measure_server_load(minutes);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "nbvopt_bench_server: " << error.what() << '\n';
    return 1;
  }
}
