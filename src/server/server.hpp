// The planning server: from its options to its end.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/planner/robot.hpp"
#include "server/limits.hpp"
#include "server/listen_address.hpp"

namespace nbvopt {

struct ServerOptions {
  Robot robot;
  /// What an expected gain begins with, unless the snapshot has more.
  HazardTable hazards = HazardTable();
  std::filesystem::path map_file;          ///< empty: none
  std::optional<double> new_resolution_m;  ///< of an empty map where there is no file
  std::filesystem::path snapshot_file;     ///< empty: none
  std::chrono::milliseconds snapshot_every{10'000};
  std::filesystem::path data_folder;  ///< empty: clients name no files
  std::string listen = "127.0.0.1:50051";
  std::string web;  ///< where WebServer listens; empty: nowhere
  TlsFiles tls;
  ServerLimits limits;
  std::size_t planning_threads = 2;
};

/// A server that listens from its construction until stop(), or its destruction.
class Server {
 public:
  /// Loads the snapshot, else the map, else starts an empty one. Throws InputError and UsageError
  /// for what cannot be used: nothing is listening then.
  explicit Server(const ServerOptions& options);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();

  /// Where it listens, the port that the system chose for 0 filled in.
  std::string address() const;

  /// Where browsers and monitors find it; empty where they do not.
  std::string web_address() const;

  /// Whether its own call of GetStatus is answered within that time, and clients are let in. The
  /// call takes a connection of its own, which finds a place when no client does.
  bool answers_itself(std::chrono::milliseconds timeout) const;

  /// Ends or cancels the calls in flight and writes the last snapshot. Throws InputError when that
  /// cannot be written.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace nbvopt
