// Faults of clients: after each the server still answers and its map is intact.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>

#include "server/call_log.hpp"
#include "server/running_server.hpp"
#include "support/error_message.hpp"
#include "support/paths.hpp"
#include "support/wait_for_search.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

v1::InsertScanRequest scan_request(int i = 0) {
  v1::InsertScanRequest request;
  *request.mutable_sensor() = to_message(test::scan_pose(i));
  *request.mutable_points() = to_message(test::small_scan());
  return request;
}

class ServerFaults : public ::testing::Test {
 protected:
  void TearDown() override {
    // Busy at most until what was cancelled is cleared away.
    EXPECT_TRUE(test::wait_until([&] {
      try {
        EXPECT_NE(running.client.plan(test::small_request()).result.status, PlanStatus::not_run);
        EXPECT_EQ(running.map_bytes(), expected_bytes);
        return true;
      } catch (const ServerError& error) {
        EXPECT_EQ(error.kind(), ServerErrorKind::busy);
        return false;
      }
    }));
  }

  grpc::Status insert(const v1::InsertScanRequest& request) const {
    grpc::ClientContext context;
    v1::InsertScanReply reply;
    return stub->InsertScan(&context, request, &reply);
  }

  static constexpr int kMaxStreams = 5;

  test::RunningServer running{
      {.max_map_extent_m = 100.0, .max_waiting = 8, .max_streams = kMaxStreams}};
  std::unique_ptr<v1::Planner::Stub> stub = running.stub();
  std::string expected_bytes = map_file_bytes(test::small_map(), MapFormat::uncertainty_ot);
};

TEST_F(ServerFaults, ClientIsGoneInTheMiddleOfAPlanStream) {
  for (int i = 0; i < 20; ++i) {
    grpc::ClientContext context;
    const auto stream = stub->PlanStream(&context);
    stream->Write(to_message(test::small_request()));
    v1::PlanReply reply;
    EXPECT_TRUE(stream->Read(&reply));
    stream->Write(i % 2 == 0 ? test::RunningServer::long_request()
                             : to_message(test::small_request()));
    if (i % 4 == 0) {
      EXPECT_TRUE(test::wait_for_search());
    }
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
}

TEST_F(ServerFaults, ClientIsGoneInTheMiddleOfScans) {
  UncertaintyMap expected = test::small_map();
  grpc::ClientContext context;
  const auto stream = stub->InsertScans(&context);
  stream->Write(scan_request());
  EXPECT_TRUE(test::wait_until([&] { return running.client.status().map_version == 2; }));
  context.TryCancel();
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  insert_scan(expected, test::small_scan(), test::scan_pose(0), test::small_robot().sensor);
  expected_bytes = map_file_bytes(expected, MapFormat::uncertainty_ot);
}

TEST_F(ServerFaults, ClientIsGoneWhileItTakesTheMap) {
  grpc::ClientContext context;
  const auto reader = stub->GetMap(&context, {});
  context.TryCancel();
  reader->Finish();
}

/// Those who read get the map, however long they take in all; who stops reading is let go.
TEST(StalledReader, IsLeftAlone) {
  ServerLimits limits;
  limits.max_send_s = 0.5;
  test::RunningServer running(limits);
  running.client.clear_map(0.01);
  for (int i = 0; i < 8; ++i) {
    running.client.insert_scan(test::small_scan(), test::scan_pose(12 * i));
  }
  const auto stub = running.stub();
  grpc::ClientContext context;
  const auto reader = stub->GetMap(&context, {});
  v1::MapChunk chunk;
  ASSERT_TRUE(reader->Read(&chunk));
  ASSERT_GT(chunk.total_bytes(), 8U << 20) << "more than waits on the way";
  const auto failed = [&] {
    v1::GetStatusReply status;
    grpc::ClientContext other;
    EXPECT_TRUE(stub->GetStatus(&other, {}, &status).ok());
    return status.latencies(static_cast<int>(Method::get_map)).failed();
  };
  EXPECT_TRUE(test::wait_until([&] { return failed() == 1; }));
  std::uint64_t received = chunk.data().size();
  while (reader->Read(&chunk)) received += chunk.data().size();
  EXPECT_LT(received, chunk.total_bytes());
  EXPECT_FALSE(reader->Finish().ok());
  EXPECT_GT(running.client.get_map().bytes.size(), 8U << 20);
}

/// A million rays at voxels of a centimetre take seconds.
TEST_F(ServerFaults, ClientIsGoneInTheMiddleOfALongScan) {
  const std::uint64_t cleared = running.client.clear_map(0.01);
  Scan scan;
  for (int i = 0; i < 1'000'000; ++i) {
    scan.no_returns.push_back({0.002F * static_cast<float>(i % 1000 - 500),
                               0.002F * static_cast<float>(i / 1000 - 500), 1.0F});
  }
  v1::InsertScanRequest request = scan_request();
  *request.mutable_points() = to_message(scan);
  for (const bool is_stream : {false, true}) {
    grpc::ClientContext context;
    std::thread canceller([&] {
      EXPECT_TRUE(test::wait_for_search());
      context.TryCancel();
    });
    v1::InsertScanReply reply;
    if (is_stream) {
      const auto stream = stub->InsertScans(&context);
      stream->Write(request);
      EXPECT_FALSE(stream->Read(&reply));
      EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
    } else {
      EXPECT_EQ(stub->InsertScan(&context, request, &reply).error_code(),
                grpc::StatusCode::CANCELLED);
    }
    canceller.join();
  }
  EXPECT_EQ(running.client.insert_scan(test::small_scan(), test::scan_pose(0)).map_version,
            cleared + 1);
  running.client.load_map("map.ot");
}

TEST_F(ServerFaults, HalfAScan) {
  v1::InsertScanRequest request = scan_request();
  request.mutable_points()->mutable_xyz_m()->resize(1001);
  EXPECT_EQ(insert(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(ServerFaults, PointsThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Scan scan;
  scan.points_m = {{nan, 0, 1}, {0, infinity, 1}, {0, 0, -infinity}};
  scan.no_returns = {{nan, nan, nan}};
  const ScanReceipt receipt = running.client.insert_scan(scan, test::scan_pose(0));
  EXPECT_EQ(receipt.points_used, 0U);
  EXPECT_EQ(receipt.voxels_changed, 0U);
  EXPECT_EQ(receipt.points_ignored, 4U);
  EXPECT_EQ(receipt.points_not_finite, 4U);
}

TEST_F(ServerFaults, PointsInMillimetres) {
  Scan scan;
  scan.points_m = {{0, 0, 1500}, {10, 0, 1600}};
  v1::InsertScanRequest request;
  *request.mutable_sensor() = to_message(test::scan_pose(0));
  *request.mutable_points() = to_message(scan);
  const grpc::Status status = insert(request);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), ::testing::HasSubstr("millimetres"));
}

TEST_F(ServerFaults, PointsBeyondTheLattice) {
  Scan scan;
  scan.points_m = {{0.0F, 0.0F, 1e30F}, {3e9F, 0.0F, 1.0F}};
  v1::InsertScanRequest request;
  *request.mutable_sensor() = to_message(test::scan_pose(0));
  request.mutable_sensor()->set_x_m(1e6);  // the camera, too
  *request.mutable_points() = to_message(scan);
  EXPECT_EQ(insert(request).error_code(), grpc::StatusCode::OUT_OF_RANGE);
  request.mutable_sensor()->set_x_m(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(insert(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(ServerFaults, DeadlinesOfNothingAndOfAMillisecond) {
  for (const auto deadline : {-1000ms, 0ms, 1ms, 5ms}) {
    for (int i = 0; i < 10; ++i) {
      grpc::ClientContext context;
      context.set_deadline(std::chrono::system_clock::now() + deadline);
      v1::PlanReply reply;
      const grpc::Status status = stub->Plan(&context, test::RunningServer::long_request(), &reply);
      if (!status.ok()) {
        EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
      } else {
        EXPECT_EQ(reply.status(), v1::PLAN_STATUS_TIME_LIMIT);
      }
    }
  }
}

TEST_F(ServerFaults, ADeadlineIsALimitOfComputing) {
  // A busy machine may be late with an answer, but not every time.
  EXPECT_TRUE(test::wait_until([&] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + 1s);
    v1::PlanReply reply;
    if (!stub->Plan(&context, test::RunningServer::long_request(), &reply).ok()) return false;
    EXPECT_EQ(reply.status(), v1::PLAN_STATUS_TIME_LIMIT);
    EXPECT_GT(reply.evaluations(), 1);
    return true;
  }));
}

TEST_F(ServerFaults, CancelledSearchesEnd) {
  // More than there are threads: a search that went on would keep the last plan waiting for ever.
  for (int i = 0; i < 4; ++i) {
    grpc::ClientContext context;
    v1::PlanReply reply;
    std::thread canceller([&] {
      EXPECT_TRUE(test::wait_for_search());
      context.TryCancel();
    });
    EXPECT_EQ(stub->Plan(&context, test::RunningServer::long_request(), &reply).error_code(),
              grpc::StatusCode::CANCELLED);
    canceller.join();
  }
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + 60s);
  v1::PlanReply reply;
  EXPECT_TRUE(stub->Plan(&context, to_message(test::small_request()), &reply).ok());
}

TEST_F(ServerFaults, TwoHundredClientsAtOnce) {
  constexpr int kClients = 200;
  std::atomic<int> answered{0};
  std::atomic<int> shed{0};
  std::vector<std::thread> clients;
  for (int i = 0; i < kClients; ++i) {
    clients.emplace_back([&] {
      grpc::ChannelArguments own_connection;
      own_connection.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
      const auto mine = v1::Planner::NewStub(grpc::CreateCustomChannel(
          running.server.address(), grpc::InsecureChannelCredentials(), own_connection));
      grpc::ClientContext context;
      v1::PlanReply reply;
      const grpc::Status status = mine->Plan(&context, to_message(test::small_request()), &reply);
      if (status.ok()) ++answered;
      if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) ++shed;
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(answered + shed, kClients);
  EXPECT_GT(answered, 0);
}

TEST_F(ServerFaults, MoreThanItCanDoIsShed) {
  // Two threads at work, eight calls waiting: the others hear so at once.
  constexpr int kCalls = 30;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::thread> calls;
  std::atomic<int> shed{0};
  for (int i = 0; i < kCalls; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    calls.emplace_back([&, context = contexts.back().get()] {
      v1::PlanReply reply;
      const auto code =
          stub->Plan(context, test::RunningServer::long_request(), &reply).error_code();
      if (code == grpc::StatusCode::RESOURCE_EXHAUSTED) ++shed;
    });
  }
  EXPECT_TRUE(test::wait_until([&] { return shed == kCalls - 10; }));
  for (const auto& context : contexts) context->TryCancel();
  for (std::thread& call : calls) call.join();
  v1::GetStatusReply status;
  grpc::ClientContext context;
  ASSERT_TRUE(stub->GetStatus(&context, {}, &status).ok());
  EXPECT_EQ(status.latencies(0).shed(), static_cast<std::uint64_t>(kCalls - 10));
}

TEST_F(ServerFaults, AMessageThatIsTooLarge) {
  v1::InsertScanRequest request = scan_request();
  request.mutable_points()->mutable_xyz_m()->resize(12 << 21);
  const grpc::Status refused = insert(request);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::OUT_OF_RANGE);
  EXPECT_THAT(refused.error_message(), HasSubstr("25 MiB, the limit is 16 MiB (max_message_mib)"));
  request.mutable_points()->mutable_xyz_m()->resize(12 << 22);
  EXPECT_EQ(insert(request).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST_F(ServerFaults, AFileThatGoesWhileItLoads) {
  const std::string file = running.folder / "going.ot";
  int loaded = 0;
  constexpr int kTries = 20;
  for (int i = 0; i < kTries; ++i) {
    std::filesystem::copy_file(test::datasets_dir() / "office_partial.ot", file);
    // From "before it is opened" to "while it is read".
    std::thread remover([&, delay = std::chrono::microseconds(250 * i)] {
      std::this_thread::sleep_for(delay);
      std::filesystem::remove(file);
    });
    if (i == 0) remover.join();
    const std::string message =
        test::message_of<ServerError>([&] { running.client.load_map("going.ot"); });
    if (i > 0) remover.join();
    if (message.empty()) {
      ++loaded;
    } else {
      EXPECT_THAT(message, HasSubstr("No such file"));
    }
  }
  EXPECT_LT(loaded, kTries);
  running.client.load_map("map.ot");
}

TEST_F(ServerFaults, MoreStreamsThanItHolds) {
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<v1::PlanRequest, v1::PlanReply>>> streams;
  for (int i = 0; i < kMaxStreams; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    streams.push_back(stub->PlanStream(contexts.back().get()));
    v1::PlanReply reply;
    streams.back()->Write(to_message(test::small_request()));
    EXPECT_TRUE(streams.back()->Read(&reply));
  }
  grpc::ClientContext context;
  EXPECT_EQ(stub->InsertScans(&context)->Finish().error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
  for (std::size_t i = 0; i < streams.size(); ++i) {
    streams[i]->WritesDone();
    EXPECT_TRUE(streams[i]->Finish().ok());
  }
}

TEST_F(ServerFaults, StreamsLeavePlacesToOtherCalls) {
  const test::RunningServer other({.max_waiting = 2});
  const auto other_stub = other.stub();
  constexpr int kStreams = 6;  // two are at work, two wait, two are shed
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<v1::PlanRequest, v1::PlanReply>>> streams;
  for (int i = 0; i < kStreams; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    streams.push_back(other_stub->PlanStream(contexts.back().get()));
    streams.back()->Write(test::RunningServer::long_request());
  }
  const auto shed = [&] {
    grpc::ClientContext context;
    v1::GetStatusReply status;
    EXPECT_TRUE(other_stub->GetStatus(&context, {}, &status).ok());
    return status.latencies(1).shed();
  };
  EXPECT_TRUE(test::wait_until([&] { return shed() == 2; }));
  std::jthread canceller([&] {
    EXPECT_TRUE(test::wait_for_search());
    for (const auto& context : contexts) context->TryCancel();
  });
  grpc::ClientContext context;
  v1::PlanReply reply;
  EXPECT_TRUE(other_stub->Plan(&context, to_message(test::small_request()), &reply).ok());
  for (const auto& stream : streams) stream->Finish();
}

TEST_F(ServerFaults, StopsInTheMiddleOfCalls) {
  test::RunningServer other;
  const auto other_stub = other.stub();
  std::vector<std::thread> calls;
  for (int i = 0; i < 3; ++i) {
    calls.emplace_back([&] {
      grpc::ClientContext context;
      v1::PlanReply reply;
      EXPECT_FALSE(other_stub->Plan(&context, test::RunningServer::long_request(), &reply).ok());
    });
  }
  EXPECT_TRUE(test::wait_for_search());
  other.client.insert_scan(test::small_scan(), test::scan_pose(0));
  other.server.stop();
  for (std::thread& call : calls) call.join();
  UncertaintyMap expected = test::small_map();
  insert_scan(expected, test::small_scan(), test::scan_pose(0), test::small_robot().sensor);
  EXPECT_EQ(map_file_bytes(read_map(std::filesystem::path(other.folder / "snapshot.ot")),
                           MapFormat::uncertainty_ot),
            map_file_bytes(expected, MapFormat::uncertainty_ot));
}

}  // namespace
}  // namespace nbvopt
