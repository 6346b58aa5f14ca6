#include "bench/server_load.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "bench/latencies.hpp"
#include "bench/resident_memory.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "nbvopt/sim/world.hpp"
#include "support/paths.hpp"
#include "support/server_process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kScanPeriod = 100ms;
constexpr auto kPlanPeriod = 50ms;

/// What the robot sees on its drive, made before the clock runs.
struct Frame {
  Transform T_map_base;
  Transform T_map_sensor;
  Scan scan;
};

std::vector<Frame> drive_through_the_office() {
  constexpr std::size_t kFrames = 300;
  constexpr JointPosition kJoints{.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
  const Scene scene(read_world(test::datasets_dir() / "office.world", {}).mesh);
  const Trajectory way =
      explore(scene, base_pose(0.62, 0.71, 0.0, 0.0), ExplorationOptions{}).trajectory;
  const Robot robot;
  const SimulatedCamera camera(scene, robot.sensor, 0.0, 1);
  const Mast mast(robot.mast);
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double time_s = way.duration_s() * static_cast<double>(i) / kFrames;
    const Transform T_map_base = way.T_map_base(time_s);
    const Transform T_map_sensor = T_map_base * mast.T_base_sensor(kJoints);
    frames.push_back({T_map_base, T_map_sensor, camera.capture(T_map_sensor, i)});
  }
  return frames;
}

/// Calls `work(i)` at a steady rate until `end`; one that takes too long makes the next one late,
/// and none is left out.
template <typename Work>
void at_rate(Clock::duration period, Clock::time_point end, const Work& work) {
  Clock::time_point next = Clock::now();
  for (std::size_t i = 0; next < end; ++i, next += period) {
    std::this_thread::sleep_until(next);
    work(i);
  }
}

}  // namespace

std::string measure_server_load(double minutes) {
  const std::vector<Frame> frames = drive_through_the_office();
  const test::TemporaryFolder folder;
  test::ServerProcess server(
      test::cli_program(),
      {"serve", "--create", "0.1", "--snapshot", folder / "snapshot.ot", "--listen", "127.0.0.1:0"},
      folder / "log");
  PlannerClient client(server.address());
  const auto elapsed_ms = [](Clock::time_point since) {
    return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
  };
  const auto start = Clock::now();
  const auto end =
      start + std::chrono::duration_cast<Clock::duration>(minutes * std::chrono::minutes(1));

  std::atomic<std::size_t> frame{0};
  Latencies scans;
  std::thread scanner([&] {
    PlannerClient own(server.address());
    at_rate(kScanPeriod, end, [&](std::size_t i) {
      frame = i % frames.size();
      const auto begin = Clock::now();
      own.insert_scan(frames[frame].scan, frames[frame].T_map_sensor);
      scans.add(elapsed_ms(begin));
    });
  });
  Latencies plans;
  int missed = 0;
  std::thread asker([&] {
    PlannerClient own(server.address(), {}, kPlanPeriod);
    at_rate(kPlanPeriod, end, [&](std::size_t) {
      PlanRequest request;
      request.T_map_base = frames[frame].T_map_base;
      request.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
      request.motion_time_s = 0.5;
      const auto begin = Clock::now();
      try {
        own.plan(request);
        plans.add(elapsed_ms(begin));
      } catch (const ServerError&) {
        ++missed;
      }
    });
  });

  std::string memory =
      "| minute | scans | resident, MB | tree nodes | information |\n"
      "| ---: | ---: | ---: | ---: | ---: |\n";
  const int samples = std::max(1, static_cast<int>(std::lround(minutes)));
  for (int sample = 1; sample <= samples; ++sample) {
    std::this_thread::sleep_until(start + (end - start) * sample / samples);
    const ServerStatus status = client.status(true);
    memory +=
        formatted("| %.1f | %llu | %.1f | %llu | %.0f |\n", elapsed_ms(start) / 60e3,
                  static_cast<unsigned long long>(status.scans), resident_mb(server.process().id()),
                  static_cast<unsigned long long>(status.counts.nodes), status.counts.information);
  }
  scanner.join();
  asker.join();
  return formatted("10 scans of 480 x 360 and 20 plans a second for %.1f minutes, 0.1 m:\n\n",
                   minutes) +
         Latencies::header() + scans.row("a scan, until it is in the map") + plans.row("a plan") +
         formatted("\n%d plans missed their deadline of 50 ms, or failed.\n\n", missed) + memory;
}

}  // namespace nbvopt::bench
