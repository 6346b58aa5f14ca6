// The server through its clients: every call, and what they answer.
#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <future>
#include <thread>

#include "nbvopt/gain/hazard_file.hpp"
#include "nbvopt/solver/registry.hpp"
#include "server/running_server.hpp"
#include "support/error_message.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;

std::string text_of(const grpc::ByteBuffer& bytes) {
  std::vector<grpc::Slice> slices;
  bytes.Dump(&slices);
  std::string text;
  for (const grpc::Slice& slice : slices) text.append(slice.begin(), slice.end());
  return text;
}

class ServerTest : public ::testing::Test {
 protected:
  test::RunningServer running;
  PlannerClient& client = running.client;
};

TEST_F(ServerTest, PlansToTheLastBitAsThePlannerDoes) {
  const ViewPlanner planner(test::small_map(), test::small_robot());
  for (const char* solver : {"auto", "random", "nlopt:crs2"}) {
    PlanRequest request = test::small_request();
    request.seed = 5;
    request.stop.max_evaluations = 150;
    const PlanResult expected = planner.plan(request, *make_solver(solver, {}));
    const PlanResult result = client.plan(request, {.solver = solver}).result;
    EXPECT_EQ(result.joints, expected.joints);
    EXPECT_EQ(result.view, expected.view);
    EXPECT_EQ(result.current, expected.current);
    EXPECT_EQ(result.T_map_sensor.matrix(), expected.T_map_sensor.matrix());
    EXPECT_EQ(result.status, expected.status);
    EXPECT_EQ(result.message, expected.message);
    EXPECT_EQ(result.evaluations, expected.evaluations);
    EXPECT_EQ(result.solver, solver);
  }
}

TEST_F(ServerTest, GrowsAndGivesItsMap) {
  UncertaintyMap expected = test::small_map();
  for (int i = 0; i < 3; ++i) {
    const ScanReceipt receipt = client.insert_scan(test::small_scan(), test::scan_pose(i));
    const InsertResult result =
        insert_scan(expected, test::small_scan(), test::scan_pose(i), test::small_robot().sensor);
    EXPECT_EQ(receipt.map_version, static_cast<std::uint64_t>(i + 2));
    EXPECT_EQ(receipt.voxels_changed, result.changes.size());
    EXPECT_GE(receipt.durable_version, 1U);
  }
  for (const MapFormat format : {MapFormat::uncertainty_ot, MapFormat::bt, MapFormat::colour_ply}) {
    EXPECT_EQ(client.get_map(format).bytes, map_file_bytes(expected, format));
  }
  EXPECT_EQ(client.get_map().map_version, 4U);
}

TEST_F(ServerTest, EvaluatesLoadsSavesClearsAndTells) {
  const std::vector<Transform> poses{test::scan_pose(0), test::scan_pose(9)};
  const RemoteGains gains = client.evaluate(poses);
  ASSERT_EQ(gains.gains.size(), 2U);
  EXPECT_EQ(client.evaluate({}).gains.size(), 0U);
  EXPECT_EQ(client.save_map("other.bt", MapFormat::bt), 1U);
  EXPECT_EQ(client.clear_map(0.2), 2U);
  EXPECT_EQ(client.load_map("other.bt"), 3U);
  const ServerStatus status = client.status(true);
  EXPECT_EQ(status.map_version, 3U);
  EXPECT_EQ(status.counts.occupied_voxels, 200U);
  EXPECT_EQ(status.resolution_m, 0.1);
  EXPECT_EQ(status.snapshot_error, "");
  EXPECT_GE(status.durable_version, 1U);
  EXPECT_THAT(status.versions, HasSubstr("gRPC"));
}

TEST_F(ServerTest, InsertsAStreamOfScans) {
  const auto stub = running.stub();
  grpc::ClientContext context;
  const auto stream = stub->InsertScans(&context);
  UncertaintyMap expected = test::small_map();
  for (int i = 0; i < 20; ++i) {
    v1::InsertScanRequest scan;
    *scan.mutable_sensor() = to_message(test::scan_pose(i));
    *scan.mutable_points() = to_message(test::small_scan());
    ASSERT_TRUE(stream->Write(scan));
    v1::InsertScanReply reply;
    ASSERT_TRUE(stream->Read(&reply));
    EXPECT_EQ(reply.map_version(), static_cast<std::uint64_t>(i + 2));
    EXPECT_GE(reply.durable_version(), 1U);
    insert_scan(expected, test::small_scan(), test::scan_pose(i), test::small_robot().sensor);
  }
  stream->WritesDone();
  ASSERT_TRUE(stream->Finish().ok());
  EXPECT_EQ(running.map_bytes(), map_file_bytes(expected, MapFormat::uncertainty_ot));
}

TEST_F(ServerTest, AnswersAStreamOfStates) {
  const auto stub = running.stub();
  grpc::ClientContext context;
  const auto stream = stub->PlanStream(&context);
  v1::PlanRequest request = to_message(test::small_request());
  v1::PlanReply reply;
  for (std::uint64_t id = 1; id <= 5; ++id) {
    request.set_request_id(id);
    ASSERT_TRUE(stream->Write(request));
    ASSERT_TRUE(stream->Read(&reply));
    EXPECT_EQ(reply.request_id(), id);
    EXPECT_EQ(reply.map_version(), 1U);
  }
  stream->WritesDone();
  EXPECT_FALSE(stream->Read(&reply));
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(ServerTest, AnswersTheNewestOfManyStates) {
  const auto stub = running.stub();
  grpc::ClientContext context;
  const auto stream = stub->PlanStream(&context);
  constexpr std::uint64_t kStates = 200;
  std::thread writer([&] {
    v1::PlanRequest request = to_message(test::small_request());
    for (std::uint64_t id = 1; id <= kStates; ++id) {
      request.set_request_id(id);
      stream->Write(request);
    }
    stream->WritesDone();
  });
  std::uint64_t answers = 0;
  std::uint64_t last = 0;
  v1::PlanReply reply;
  while (stream->Read(&reply)) {
    EXPECT_GT(reply.request_id(), last);
    last = reply.request_id();
    ++answers;
  }
  writer.join();
  EXPECT_TRUE(stream->Finish().ok());
  EXPECT_EQ(last, kStates);  // the newest is always answered
  EXPECT_LT(answers, kStates);
}

TEST_F(ServerTest, SaysWhichScansOfAStreamAreInTheMap) {
  const auto stub = running.stub();
  grpc::ClientContext context;
  const auto stream = stub->InsertScans(&context);
  v1::InsertScanRequest scan;
  *scan.mutable_sensor() = to_message(test::scan_pose(0));
  *scan.mutable_points() = to_message(test::small_scan());
  v1::InsertScanReply reply;
  stream->Write(scan);
  EXPECT_TRUE(stream->Read(&reply));
  scan.clear_scan();
  stream->Write(scan);
  EXPECT_FALSE(stream->Read(&reply));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(client.status().map_version, reply.map_version());
}

TEST_F(ServerTest, TellsWhatIsWrongWithACall) {
  const auto stub = running.stub();
  const auto code_of_plan = [&](const v1::PlanRequest& request) {
    grpc::ClientContext context;
    v1::PlanReply reply;
    return stub->Plan(&context, request, &reply).error_code();
  };
  EXPECT_EQ(code_of_plan({}), grpc::StatusCode::INVALID_ARGUMENT);
  v1::PlanRequest request = to_message(test::small_request());
  request.mutable_search()->set_solver("nlopt:none");
  EXPECT_EQ(code_of_plan(request), grpc::StatusCode::INVALID_ARGUMENT);
  request.mutable_search()->set_solver("ceres:lm");
  EXPECT_EQ(code_of_plan(request), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(test::message_of<ServerError>([&] { client.load_map("../map.ot"); }),
              HasSubstr("'..' is not allowed"));
  EXPECT_THAT(test::message_of<ServerError>([&] { client.load_map("none.ot"); }),
              HasSubstr("No such file"));
  EXPECT_THAT(test::message_of<ServerError>([&] { client.save_map("snapshot.ot"); }),
              HasSubstr("own file"));
  EXPECT_THAT(test::message_of<ServerError>([&] { client.clear_map(1e-6); }),
              HasSubstr("min_resolution_m"));
}

TEST_F(ServerTest, KeepsItsSocketToItself) {
  struct stat status {};
  ASSERT_EQ(::stat((running.folder / "socket").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  ServerOptions second;
  second.new_resolution_m = 0.1;
  second.listen = running.server.address();
  EXPECT_THAT(test::message_of<InputError>([&] { Server server(second); }),
              HasSubstr("another server uses this socket"));
  second.listen = "127.0.0.1:0";
  second.snapshot_file = running.folder / "snapshot.ot";
  EXPECT_THAT(test::message_of<InputError>([&] { Server server(second); }),
              HasSubstr("another server uses this snapshot"));
  second.snapshot_file.clear();
  Server third(second);
  second.listen = third.address();
  EXPECT_THAT(test::message_of<InputError>([&] { Server server(second); }),
              HasSubstr("cannot listen on 127.0.0.1:"));
  EXPECT_EQ(client.status().map_version, 1U);
}

/// What the health service says of the planner.
std::string health(const std::shared_ptr<grpc::Channel>& channel) {
  // grpc.health.v1.HealthCheckRequest{service: "nbvopt.v1.Planner"} as bytes.
  grpc::GenericStub generic(channel);
  const std::string service = "nbvopt.v1.Planner";
  const grpc::Slice slice(std::string("\x0A") + static_cast<char>(service.size()) + service);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer reply;
  grpc::ClientContext context;
  std::promise<grpc::Status> done;
  generic.UnaryCall(&context, "/grpc.health.v1.Health/Check", {}, &request, &reply,
                    [&](grpc::Status status) { done.set_value(std::move(status)); });
  EXPECT_TRUE(done.get_future().get().ok());
  return text_of(reply);
}

constexpr const char* kServing = "\x08\x01";
constexpr const char* kNotServing = "\x08\x02";

/// A channel with a connection of its own.
std::shared_ptr<grpc::Channel> own_channel(const std::string& address) {
  grpc::ChannelArguments own_connection;
  own_connection.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), own_connection);
}

TEST_F(ServerTest, TellsItsHealth) {
  EXPECT_EQ(health(own_channel(running.server.address())), kServing);
}

TEST(Server, TellsThatItHasNoRoomForClients) {
  test::RunningServer running({.max_connections = 2});
  const auto first = own_channel(running.server.address());
  EXPECT_EQ(health(first), kServing);
  auto second = own_channel(running.server.address());
  health(second);  // connects; it may see what it brings about
  EXPECT_TRUE(test::wait_until([&] { return health(first) == kNotServing; }));
  // The client has its own, third connection.
  EXPECT_THAT(test::message_of<ServerError>([&] { running.client.status(); }),
              HasSubstr("no server answers there"));
  second.reset();
  EXPECT_TRUE(test::wait_until([&] { return health(first) == kServing; }));
  PlannerClient late(running.server.address());
  const ServerStatus status = late.status();
  EXPECT_EQ(status.connections, 2U);
  EXPECT_GE(status.connections_refused, 1U);
}

TEST_F(ServerTest, TellsItsServicesByReflection) {
  const auto channel =
      grpc::CreateChannel(running.server.address(), grpc::InsecureChannelCredentials());
  grpc::GenericStub generic(channel);
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  const auto step = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  const auto call = generic.PrepareCall(
      &context, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", &queue);
  call->StartCall(nullptr);
  ASSERT_TRUE(step());
  // ServerReflectionRequest{list_services: ""} as bytes.
  const grpc::Slice slice(std::string("\x3A\x00", 2));
  call->Write(grpc::ByteBuffer(&slice, 1), nullptr);
  ASSERT_TRUE(step());
  grpc::ByteBuffer reply;
  call->Read(&reply, nullptr);
  ASSERT_TRUE(step());
  EXPECT_THAT(text_of(reply), HasSubstr("nbvopt.v1.Planner"));
  EXPECT_THAT(text_of(reply), HasSubstr("grpc.health.v1.Health"));
  context.TryCancel();
  grpc::Status status;
  call->Finish(&status, nullptr);
  step();
}

TEST(Server, ResumesFromItsSnapshot) {
  const test::TemporaryFolder folder;
  ServerOptions options;
  options.robot = test::small_robot();
  options.new_resolution_m = 0.1;
  options.snapshot_file = folder / "snapshot.ot";
  options.listen = "unix:" + (folder / "socket");
  std::string bytes;
  {
    Server server(options);
    PlannerClient client(server.address());
    for (int i = 0; i < 3; ++i) client.insert_scan(test::small_scan(), test::scan_pose(i));
    bytes = client.get_map().bytes;
    server.stop();
  }
  Server server(options);
  PlannerClient client(server.address());
  EXPECT_EQ(client.status().map_version, 4U);
  EXPECT_EQ(client.status().durable_version, 4U);
  EXPECT_EQ(client.get_map().bytes, bytes);
}

TEST(Server, KeepsWhatItsScansTaughtOverARestart) {
  const test::TemporaryFolder folder;
  ServerOptions options;
  options.robot = test::small_robot();
  options.robot.sensor.gain = GainKind::expected;
  options.new_resolution_m = 0.1;
  options.snapshot_file = folder / "snapshot.ot";
  options.listen = "unix:" + (folder / "socket");
  const auto plan = [](PlannerClient& client) {
    PlanRequest request;
    request.joints.height_m = 0.4;
    request.motion_time_s = 0.5;
    return client.plan(request).result.hazards;
  };
  std::optional<HazardTable> taught;
  {
    Server server(options);
    PlannerClient client(server.address());
    client.insert_scan(test::small_scan(), test::scan_pose(0));
    taught = plan(client);
    server.stop();
  }
  ASSERT_TRUE(taught);
  EXPECT_NE(*taught, HazardTable());
  EXPECT_EQ(read_hazards(options.snapshot_file), *taught);
  options.hazards = HazardTable::uniform(1.0);  // of a file: older than the snapshot
  Server server(options);
  PlannerClient client(server.address());
  EXPECT_EQ(plan(client), taught);
}

TEST(Server, NeedsAMapToStartWith) {
  EXPECT_THAT(test::message_of<UsageError>([] { Server server(ServerOptions{}); }),
              HasSubstr("no map to start with"));
}

}  // namespace
}  // namespace nbvopt
