#include "server/server.hpp"

#include <grpc/support/log.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/server_posix.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/file_lock.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/core/version.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/v1/planner.grpc.pb.h"
#include "server/acceptor.hpp"
#include "server/listening_socket.hpp"
#include "server/planner_service.hpp"
#include "server/snapshot_file.hpp"
#include "server/web/web_server.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

/// What to start with: what a snapshot holds wins over files, which are older.
Snapshot first_map(const ServerOptions& options) {
  if (!options.snapshot_file.empty()) {
    if (auto snapshot = read_snapshot(options.snapshot_file)) {
      spdlog::info("event=resumed snapshot=\"{}\" map_version={}", options.snapshot_file.string(),
                   snapshot->version);
      return std::move(*snapshot);
    }
  }
  if (!options.map_file.empty()) return {read_map(options.map_file), 1, std::nullopt};
  if (!options.new_resolution_m) {
    throw UsageError(
        "there is no map to start with: give a map file, or the resolution of an empty one");
  }
  return {UncertaintyMap(*options.new_resolution_m), 1, std::nullopt};
}

std::shared_ptr<grpc::ServerCredentials> credentials(const TlsFiles& tls) {
  if (tls.is_empty()) return grpc::InsecureServerCredentials();
  grpc::SslServerCredentialsOptions options(
      GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  options.pem_root_certs = read_text_file(tls.client_ca);
  options.pem_key_cert_pairs.push_back({read_text_file(tls.key), read_text_file(tls.certificate)});
  return grpc::SslServerCredentials(options);
}

/// What gRPC says of sockets and peers; what matters of it comes back as an error.
void log_grpc(gpr_log_func_args* line) {
  spdlog::debug("event=grpc message=\"{}\"", line->message);
}

}  // namespace

/// In the order in which they are needed; they go in the opposite one.
struct Server::Parts {
  explicit Parts(const ServerOptions& server_options)
      : options(server_options), address(parse_listen_address(options.listen)) {
    check_tls(address, options.tls);
    if (address.socket) socket_lock.emplace(*address.socket, "server uses this socket");
    open_map();
    if (!options.data_folder.empty()) data.emplace(options.data_folder, own_files());
    handler.emplace(*store, snapshots ? &*snapshots : nullptr, data ? &*data : nullptr,
                    options.limits);
    service.emplace(*handler, connection_log, options.planning_threads);
    if (!options.web.empty()) {
      web.emplace(options.web, options.limits, web_sources());
    }
    listen();
  }

  WebSources web_sources() const {
    return {.status = [this] { return service->status({}); },
            .live = {.title = options.map_file.empty() ? "live map" : options.map_file.string(),
                     .run_id = handler->run_id(),
                     .published = [this] { return store->published(); },
                     .newest_plan = [this] { return handler->plans().newest(); }}};
  }

  void open_map() {
    const bool keeps_snapshots = !options.snapshot_file.empty();
    if (keeps_snapshots) {
      snapshot_lock.emplace(options.snapshot_file, "server uses this snapshot");
      remove_unfinished_files(options.snapshot_file);
    }
    Snapshot first = first_map(options);
    store.emplace(options.robot, options.limits, std::move(first.map), first.version,
                  first.hazards.value_or(options.hazards));
    if (!keeps_snapshots) return;
    snapshots.emplace(*store, options.snapshot_file, options.snapshot_every);
    snapshots->save();  // a disk that is full or not writable shows before the first scan
  }

  /// What clients must not write.
  std::vector<fs::path> own_files() const {
    std::vector<fs::path> files;
    if (!options.snapshot_file.empty()) files.push_back(options.snapshot_file);
    if (socket_lock) files.push_back(socket_lock->path());
    if (snapshot_lock) files.push_back(snapshot_lock->path());
    return files;
  }

  void listen() {
    std::vector<Descriptor> sockets = listen_on(address);
    start_server();
    const auto most = static_cast<std::size_t>(options.limits.max_connections);
    const std::size_t of_web =
        web ? static_cast<std::size_t>(options.limits.max_web_connections) : 0;
    const SocketBudget budget = socket_budget(most, of_web);
    if (budget.connections < most) {
      spdlog::warn("event=few_descriptors max_connections={} note=\"raise ulimit -n\"",
                   budget.connections);
    }
    acceptor.emplace(
        std::move(sockets), budget, connection_log,
        Acceptor::Hooks{
            .hand_over =
                [this](int connection, int listening) {
                  grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters it;
                  it.fd = connection;
                  it.listener_fd = listening;
                  connections->HandleNewConnection(&it);
                },
            .on_room =
                [this](bool has_room) {
                  // Who watches it may go to another server.
                  server->GetHealthCheckService()->SetServingStatus(has_room);
                }});
  }

  void start_server() {
    gpr_set_log_function(log_grpc);
    grpc::EnableDefaultHealthCheckService(true);
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    grpc::ServerBuilder builder;
    connections = builder.experimental().AddExternalConnectionAcceptor(
        grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD,
        credentials(options.tls));
    builder.RegisterService(&*service);
    // gRPC refuses without naming the limit; the handler names it for what goes a little beyond.
    const std::int64_t hard_limit_mib = options.limits.max_message_mib + 16;
    builder.SetMaxReceiveMessageSize(static_cast<int>(hard_limit_mib << 20));
    // Where what comes in takes more, gRPC ends streams until it does not.
    grpc::ResourceQuota quota("server");
    quota.Resize(static_cast<std::size_t>(options.limits.max_buffered_mib) << 20);
    builder.SetResourceQuota(quota);
    // A client's further calls wait on its own side.
    builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 32);
    // Who connects and does not speak HTTP/2 to the end of its greeting.
    builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, 10'000);
    // Clients that are gone without a word.
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
    // Who asks nothing gives its place away; its next call connects again by itself.
    builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, 300'000);
    server = builder.BuildAndStart();
    if (server == nullptr) {
      throw InputError("cannot listen on " + address.text + ": its certificates do not fit");
    }
    server->GetHealthCheckService()->SetServingStatus(v1::Planner::service_full_name(), true);
  }

  /// Calls in flight have until then.
  void stop_listening(std::chrono::system_clock::time_point calls_end_at) {
    if (web) web->stop();
    if (acceptor) acceptor->stop();
    std::error_code ignored;
    if (address.socket) fs::remove(*address.socket, ignored);
    if (server) server->Shutdown(calls_end_at);
  }

  const ServerOptions options;
  ListenAddress address;
  std::optional<FileLock> socket_lock;
  std::optional<FileLock> snapshot_lock;
  std::optional<DataFolder> data;
  std::optional<MapStore> store;
  std::optional<SnapshotKeeper> snapshots;
  std::optional<RequestHandler> handler;
  ConnectionLog connection_log;
  std::optional<PlannerService> service;
  std::optional<WebServer> web;
  std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> connections;
  std::unique_ptr<grpc::Server> server;
  std::optional<Acceptor> acceptor;
};

Server::Server(const ServerOptions& options) : parts_(std::make_unique<Parts>(options)) {
  spdlog::info("event=listening address=\"{}\" version={} map_version={}", address(), version(),
               parts_->store->published()->map_version());
  if (parts_->web) spdlog::info("event=web address=\"{}\"", web_address());
  if (!parts_->snapshots) {
    spdlog::warn("event=no_snapshot note=\"the map is lost when the server ends\"");
  }
}

Server::~Server() { parts_->stop_listening(std::chrono::system_clock::now()); }

std::string Server::address() const { return parts_->address.text; }

std::string Server::web_address() const { return parts_->web ? parts_->web->address() : ""; }

bool Server::answers_itself(std::chrono::milliseconds timeout) const {
  std::array<int, 2> pair{};
  if (!parts_->acceptor->has_turned_within(timeout)) return false;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, pair.data()) != 0) {
    return false;
  }
  grpc::AddInsecureChannelFromFd(parts_->server.get(), pair[0]);
  const auto stub = v1::Planner::NewStub(grpc::CreateInsecureChannelFromFd("self", pair[1]));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + timeout);
  v1::GetStatusReply reply;
  return stub->GetStatus(&context, {}, &reply).ok();
}

void Server::stop() {
  constexpr std::chrono::seconds kGrace{1};
  parts_->server->GetHealthCheckService()->SetServingStatus(false);
  parts_->stop_listening(std::chrono::system_clock::now() + kGrace);
  if (parts_->snapshots) parts_->snapshots->save();
  spdlog::info("event=stopped map_version={} durable_version={}",
               parts_->store->published()->map_version(), parts_->handler->durable_version());
}

}  // namespace nbvopt
