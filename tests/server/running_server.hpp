// A server in this process, on a socket of its own, and raw calls to it.
#pragma once

#include <grpcpp/grpcpp.h>

#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/v1/planner.grpc.pb.h"
#include "protocol/plan_messages.hpp"
#include "server/server.hpp"
#include "server/server_world.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {

class RunningServer {
 public:
  /// Without a limit of computing, so that a search that goes on shows.
  explicit RunningServer(ServerLimits limits = {}) : server(options(limits)) {}

  std::unique_ptr<v1::Planner::Stub> stub() const {
    return v1::Planner::NewStub(
        grpc::CreateChannel(server.address(), grpc::InsecureChannelCredentials()));
  }

  std::string map_bytes() { return client.get_map().bytes; }

  /// A search that takes days when nobody stops it.
  static v1::PlanRequest long_request() {
    v1::PlanRequest request = to_message(small_request());
    request.mutable_search()->set_solver("random");
    request.set_max_evaluations(1'000'000'000'000);
    return request;
  }

  TemporaryFolder folder;
  Server server;
  PlannerClient client{server.address()};

 private:
  ServerOptions options(ServerLimits limits) const {
    limits.max_compute_ms = 1e9;
    write_map(small_map(), folder / "map.ot", MapFormat::uncertainty_ot);
    ServerOptions options;
    options.robot = small_robot();
    options.map_file = folder / "map.ot";
    options.snapshot_file = folder / "snapshot.ot";
    options.data_folder = folder.path();
    options.listen = "unix:" + (folder / "socket");
    options.limits = limits;
    return options;
  }
};

}  // namespace nbvopt::test
