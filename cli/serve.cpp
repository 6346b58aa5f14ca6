#include "cli/serve.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "cli/options/arguments.hpp"
#include "cli/options/view_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "server/server.hpp"
#include "server/service_manager.hpp"
#include "server/versions.hpp"

namespace nbvopt {
namespace {

struct ServeOptions {
  RobotArguments robot;
  ServerOptions server;
  double snapshot_every_s = 10.0;
  std::string log_level = "info";
};

/// The signals that end the server, held back in all threads that are started from now on.
class EndSignals {
 public:
  EndSignals() {
    ::sigemptyset(&signals_);
    ::sigaddset(&signals_, SIGTERM);
    ::sigaddset(&signals_, SIGINT);
    ::sigaddset(&signals_, SIGHUP);  // the terminal is closed
    ::pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    ::signal(SIGPIPE, SIG_IGN);  // a log that nobody reads any more
    ::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of writing it
  }

  /// Waits for one of them.
  int wait() const {
    int signal = 0;
    ::sigwait(&signals_, &signal);
    return signal;
  }

 private:
  sigset_t signals_{};
};

/// One event a line on standard error: time, level, then key=value pairs.
void set_up_log(const std::string& level) {
  auto log = spdlog::stderr_logger_mt("nbvopt");
  log->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z level=%l %v");
  log->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(log));
}

void check_positive(const char* option, double value, const char* unit) {
  constexpr double kMost = 1e9;
  if (value > 0.0 && value <= kMost) return;
  throw InputError(std::string(option) + " is " + format_number(value) + unit +
                   ", it must be positive and at most " + format_number(kMost));
}

void check_map(const ServerOptions& server) {
  if (!server.map_file.empty() || server.new_resolution_m) return;
  if (!server.snapshot_file.empty() && std::filesystem::exists(server.snapshot_file)) return;
  throw UsageError(
      "there is no map to start with: name a MAP, or give --create M for an empty one");
}

/// A client is a descriptor, and the soft limit is often 1,024 though the hard one is far higher.
void allow_all_descriptors() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);  // where it is refused, the limit is as it was
}

/// Waits for a signal to end, and meanwhile tells the service manager that the server answers.
int wait_alive(const ServiceManager& manager, const Server& server, const EndSignals& signals) {
  const Heartbeat heartbeat(manager, [&](auto timeout) { return server.answers_itself(timeout); });
  return signals.wait();
}

void run_serve(ServeOptions& options) {
  ServerOptions& server_options = options.server;
  check_map(server_options);
  check_positive("--snapshot-every", options.snapshot_every_s, " s");
  options.snapshot_every_s = std::max(options.snapshot_every_s, 1e-3);
  check_positive("--max-compute-ms", server_options.limits.max_compute_ms, " ms");
  check_positive("--max-receive", server_options.limits.max_receive_s, " s");
  check_positive("--max-send", server_options.limits.max_send_s, " s");
  check_positive("--max-map-extent", server_options.limits.max_map_extent_m, " m");
  check_positive("--min-resolution", server_options.limits.min_resolution_m, " m");
  server_options.snapshot_every =
      std::chrono::milliseconds(std::llround(options.snapshot_every_s * 1e3));
  server_options.robot = make_robot(options.robot);
  server_options.hazards = given_hazards(options.robot).value_or(HazardTable());
  server_options.planning_threads = options.robot.threads > 0
                                        ? static_cast<std::size_t>(options.robot.threads)
                                        : std::max(1U, std::thread::hardware_concurrency());
  const ThreadLimit thread_limit(options.robot);
  const EndSignals signals;
  set_up_log(options.log_level);
  allow_all_descriptors();
  const ServiceManager manager = ServiceManager::from_environment();
  Server server(server_options);
  print_answer("listening on " + server.address() + "\n");
  if (!server.web_address().empty()) print_answer("page at " + server.web_address() + "\n");
  manager.notify("READY=1");
  const int signal = wait_alive(manager, server, signals);
  manager.notify("STOPPING=1");
  spdlog::info("event=stopping signal={}", signal);
  server.stop();
}

void add_map(CLI::App& serve, ServerOptions& options) {
  serve.option_defaults()->group("The map");
  serve.add_option("MAP", options.map_file, "the map to start with: .bt or .ot")->type_name("FILE");
  add_number(serve, "--create", options.new_resolution_m, "M",
             "without a MAP: start with an empty one, with voxels of this size");
  serve
      .add_option("--snapshot", options.snapshot_file,
                  "keep the map in this file (.ot); what is in there already wins over MAP")
      ->type_name("FILE");
  serve
      .add_option("--data-dir", options.data_folder,
                  "the folder whose maps clients may load and save [none]")
      ->type_name("DIR");
}

void add_limits(CLI::App& serve, ServerLimits& limits) {
  constexpr std::int64_t kMost = 1'000'000'000;
  serve.option_defaults()->group("Limits");
  add_whole_number(serve, "--max-message-mib", limits.max_message_mib, 1, 1024,
                   "of a message that comes in");
  add_whole_number(serve, "--max-scan-points", limits.max_scan_points, 1, kMost, "of a scan");
  add_whole_number(serve, "--max-views", limits.max_views, 1, kMost, "of a call of Evaluate");
  add_number(serve, "--max-map-extent", limits.max_map_extent_m, "M", "the map's longest side");
  add_number(serve, "--min-resolution", limits.min_resolution_m, "M", "the map's smallest voxels");
  add_whole_number(
      serve, "--max-map-mib", limits.max_map_mib, 1, kMost,
      "of the map: tree, bricks that plans read, and copies; scans that could pass it are refused");
  add_number(serve, "--max-compute-ms", limits.max_compute_ms, "MS",
             "of a plan or a call of Evaluate");
  add_whole_number(serve, "--max-streams", limits.max_streams, 1, kMost, "that are open");
  add_whole_number(serve, "--max-buffered-mib", limits.max_buffered_mib, 1, kMost,
                   "of all messages that are coming in; calls beyond are refused");
  add_number(serve, "--max-receive", limits.max_receive_s, "SECONDS",
             "until a call's message must be there");
  add_number(serve, "--max-send", limits.max_send_s, "SECONDS",
             "until a client must have taken a part of a map, 1 MiB");
  add_whole_number(serve, "--max-pinned-mib", limits.max_pinned_mib, 1, kMost,
                   "of older maps that clients still take, when another asks for one");
  add_whole_number(serve, "--max-connections", limits.max_connections, 1, kMost,
                   "of clients; fewer where the system allows few open files");
  add_whole_number(serve, "--max-web-connections", limits.max_web_connections, 2, 1000,
                   "of browsers and monitors");
  add_whole_number(serve, "--max-waiting", limits.max_waiting, 1, kMost,
                   "calls of a client that wait for a thread; more are refused with "
                   "RESOURCE_EXHAUSTED");
}

void add_access(CLI::App& serve, ServerOptions& options) {
  serve.option_defaults()->group("Who may call");
  serve
      .add_option("--listen", options.listen,
                  "HOST:PORT (port 0: one that is free) or unix:PATH; other addresses than those "
                  "of this machine need the certificates below")
      ->type_name("ADDRESS")
      ->capture_default_str();
  serve
      .add_option("--web", options.web,
                  "also show the map and the plans to browsers, and under /metrics figures to "
                  "Prometheus: HOST:PORT of this machine (port 0: one that is free) or unix:PATH "
                  "[none]")
      ->type_name("ADDRESS");
  add_pem(serve, "--tls-cert", options.tls.certificate, "the server's certificate");
  add_pem(serve, "--tls-key", options.tls.key, "its private key");
  add_pem(serve, "--tls-client-ca", options.tls.client_ca, "who signs the certificates of callers");
}

}  // namespace

void set_up_serve(CLI::App& app) {
  auto options = std::make_shared<ServeOptions>();
  CLI::App* serve = app.add_subcommand("serve", "A planning server for a robot's driver (gRPC)");
  add_map(*serve, options->server);
  add_number(*serve, "--snapshot-every", options->snapshot_every_s, "SECONDS",
             "how often, while the map changes");
  add_access(*serve, options->server);
  serve->option_defaults()->group("How it works");
  options->robot.default_gain = GainKind::expected;
  add_robot_arguments(*serve, options->robot);
  serve->add_option("--log-level", options->log_level, "debug, info, warning or error")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
      ->type_name("NAME")
      ->capture_default_str();
  add_limits(*serve, options->server.limits);
  serve->footer(
      "Prints 'listening on ADDRESS' when it is ready; logs go to standard error. SIGTERM and\n"
      "SIGINT end the calls in flight, write the last snapshot and exit with 0.\n"
      "Example: nbvopt serve --create 0.05 --snapshot map.ot --listen unix:/run/robot/nbvopt");
  serve->callback([options] { run_serve(*options); });
}

std::string tool_versions() { return server_version_report(); }

}  // namespace nbvopt
