// All that the server's threads do at the same time, on its own queues; meant for the thread
// sanitizer, which sees these threads and locks, but not gRPC's.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <vector>

#include "protocol/map_messages.hpp"
#include "protocol/plan_messages.hpp"
#include "protocol/pose_messages.hpp"
#include "server/call_log.hpp"
#include "server/request_handler.hpp"
#include "server/server_world.hpp"
#include "server/snapshot_file.hpp"
#include "server/snapshot_keeper.hpp"
#include "server/work_queue.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

TEST(Concurrency, EveryCallAtOnce) {
  constexpr int kRounds = 30;
  const test::TemporaryFolder folder;
  MapStore store(test::small_robot(), {}, test::small_map(), 1);
  SnapshotKeeper snapshots(store, folder / "snapshot.ot", std::chrono::milliseconds(1));
  const DataFolder data(folder.path());
  ServerLimits limits;
  limits.max_compute_ms = 1e9;  // sanitized on a busy machine, all calls take longer than one may
  RequestHandler handler(store, &snapshots, &data, limits);
  CallLog log;
  const StopRule stop;
  const auto now = StopRule::Clock::now();

  v1::PlanRequest plan = to_message(test::small_request());
  plan.set_max_evaluations(40);
  v1::EvaluateRequest evaluate;
  *evaluate.add_views()->mutable_sensor() = to_message(test::scan_pose(1));
  v1::InsertScanRequest scan;
  *scan.mutable_sensor() = to_message(test::scan_pose(0));
  *scan.mutable_points() = to_message(test::small_scan());
  v1::SaveMapRequest save;
  save.set_path("saved.ot");
  v1::LoadMapRequest load;
  load.set_path("saved.ot");
  v1::GetStatusRequest status;
  status.set_with_counts(true);
  handler.save_map(save);

  std::atomic<std::uint64_t> newest{0};
  const auto seen = [&newest](std::uint64_t version) {
    std::uint64_t before = newest;
    while (before < version && !newest.compare_exchange_weak(before, version)) {
    }
  };
  const std::vector<std::function<void()>> calls{
      [&] { seen(handler.plan(plan, now, stop).map_version()); },
      [&] { seen(handler.evaluate(evaluate, now, stop).map_version()); },
      [&] { seen(handler.insert_scan(scan).map_version()); },
      [&] { seen(handler.save_map(save).map_version()); },
      [&] { seen(handler.load_map(load).map_version()); },
      [&] { seen(handler.get_map({})->version); },
      [&] { seen(handler.clear_map({}).map_version()); },
      [&] {
        v1::GetStatusReply reply = handler.status(status);
        log.write(reply);
        seen(reply.map_version());
        EXPECT_LE(reply.durable_version(), store.published()->map_version());
      },
  };
  {
    WorkQueue queue(4, 1000);
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < calls.size(); ++i) {
        EXPECT_TRUE(queue.try_post([&, i] {
          calls[i]();
          log.record_answer(static_cast<Method>(i), 1.0);
        }));
      }
    }
  }
  // Scans, loads and clears each made a version, and nothing else did.
  EXPECT_EQ(store.published()->map_version(), 1U + 3U * kRounds);
  EXPECT_EQ(newest, store.published()->map_version());
  snapshots.save();
  EXPECT_EQ(read_snapshot(folder / "snapshot.ot")->version, store.published()->map_version());
}

}  // namespace
}  // namespace nbvopt
