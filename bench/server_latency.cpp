#include "bench/server_latency.hpp"

#include <chrono>

#include "bench/bench_scene.hpp"
#include "bench/latencies.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "support/paths.hpp"
#include "support/server_process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::bench {

std::string measure_server_latency(int calls) {
  const auto scene = make_bench_scenes({"ASLAM_lab"}).front();
  const test::TemporaryFolder folder;
  const test::ServerProcess server(
      test::cli_program(),
      {"serve", scene->map_file.string(), "--robot",
       folder.write("robot.yaml", to_yaml(scene->robot)), "--listen", "127.0.0.1:0"},
      folder / "log");
  PlannerClient client(server.address());
  Latencies whole;
  Latencies search;
  Latencies overhead;
  for (int i = -20; i < calls; ++i) {  // the first ones warm up
    PlanRequest request =
        scene->requests[static_cast<std::size_t>(i + 20) % scene->requests.size()];
    request.motion_time_s = 1.0;
    const auto begin = std::chrono::steady_clock::now();
    const PlanResult result = client.plan(request).result;
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - begin;
    if (i < 0) continue;
    whole.add(elapsed.count());
    search.add(result.search_time_ms);
    overhead.add(elapsed.count() - result.search_time_ms);
  }
  return "Plans on " + scene->name + ", one client on 127.0.0.1, motion time 1 s:\n\n" +
         Latencies::header() + whole.row("the call") + search.row("the search in it") +
         overhead.row("the rest") + "\n";
}

}  // namespace nbvopt::bench
