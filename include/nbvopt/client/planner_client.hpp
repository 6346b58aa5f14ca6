// A robot's driver, or any program, that asks a planning server.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/solver/search.hpp"

namespace nbvopt {

/// What a call can fail of, as the server's statuses say.
enum class ServerErrorKind {
  bad_request,  ///< a value, file or limit: the same call will fail again
  busy,         ///< the server has shed the call: ask again later
  timeout,
  cancelled,
  unavailable,  ///< no server there, or it ended
  not_saved,    ///< what was to be saved was not written: the server's disk is full or faulty
  internal,     ///< a fault of the server
};

/// A call that failed. The message is one line that names address and reason.
class ServerError : public Error {
 public:
  ServerError(ServerErrorKind kind, const std::string& message) : Error(message), kind_(kind) {}
  ServerErrorKind kind() const { return kind_; }

 private:
  ServerErrorKind kind_;
};

/// PEM files of a connection to another machine; all empty for this machine.
struct ClientTls {
  std::filesystem::path server_ca;    ///< signs the server's certificate
  std::filesystem::path certificate;  ///< the client's own
  std::filesystem::path key;          ///< the client's own
};

/// What the server says of a scan that it has taken in.
struct ScanReceipt {
  std::uint64_t map_version = 0;      ///< the first that holds the scan
  std::uint64_t durable_version = 0;  ///< of the last complete snapshot on disk; 0: none
  /// Of the server: versions of different runs must not be compared.
  std::uint64_t run_id = 0;
  std::uint64_t points_used = 0;
  std::uint64_t rays_cleared = 0;
  std::uint64_t points_ignored = 0;
  std::uint64_t voxels_changed = 0;
  double information_gained = 0.0;
  /// Where the points lie that were not used, as ScanCounts says.
  std::uint64_t points_too_near = 0;
  std::uint64_t points_too_far = 0;
  std::uint64_t no_returns = 0;
  std::uint64_t points_not_finite = 0;
  std::uint64_t points_off_lattice = 0;
};

/// An answer, and how its views were judged.
struct RemotePlan {
  PlanResult result;
  Counting counting = Counting::per_ray;
  GainChoice gain;
};

struct RemoteGains {
  std::vector<ViewGain> gains;
  std::uint64_t map_version = 0;
};

struct RemoteMap {
  std::string bytes;  ///< of a map file
  std::uint64_t map_version = 0;
};

struct ServerStatus {
  std::string version;   ///< of the server
  std::string versions;  ///< of all that it stands on, one a line
  double uptime_s = 0.0;
  std::uint64_t map_version = 0;
  std::uint64_t durable_version = 0;
  std::uint64_t run_id = 0;    ///< as in ScanReceipt
  std::string snapshot_error;  ///< empty: the last snapshot was written
  double resolution_m = 0.0;
  std::uint64_t scans = 0;                ///< since the server started
  std::uint64_t connections = 0;          ///< of clients, now
  std::uint64_t connections_refused = 0;  ///< beyond the server's max_connections
  std::uint64_t connections_silent = 0;   ///< that were closed since they said nothing
  MapCounts counts;                       ///< where asked for
  PaperCounts paper_counts;
  /// Where the robot's gain is expected: what it takes for likely of the unknown now, learnt scans
  /// and prior together.
  std::optional<HazardTable> hazards;
};

/// A connection, made when it is first needed. Every call waits for its answer at most `timeout`
/// and throws ServerError. Safe to share between threads.
class PlannerClient {
 public:
  /// `address` is HOST:PORT or unix:PATH. Throws InputError for certificates that cannot be read.
  explicit PlannerClient(const std::string& address, const ClientTls& tls = {},
                         std::chrono::milliseconds timeout = std::chrono::seconds(30));
  PlannerClient(PlannerClient&&) noexcept;
  ~PlannerClient();

  /// The request's deadline and evaluation limit are sent along; its cancel flag and its trace are
  /// not. Throws InputError for a search whose tolerance, initial step or stages' parameters, the
  /// solvers aside, are not the defaults: a server takes none.
  RemotePlan plan(const PlanRequest& request, const Search& search = {},
                  const std::optional<GainChoice>& gain = {});

  RemoteGains evaluate(std::span<const Transform> poses_T_map_sensor,
                       const std::optional<GainChoice>& gain = {});

  ScanReceipt insert_scan(const Scan& scan, const Transform& T_map_sensor);

  /// Of a file in the server's data folder; returns the map's version.
  std::uint64_t load_map(const std::string& path);
  std::uint64_t save_map(const std::string& path, MapFormat format = MapFormat::uncertainty_ot);

  RemoteMap get_map(MapFormat format = MapFormat::uncertainty_ot);

  /// Without a resolution the map keeps its own.
  std::uint64_t clear_map(std::optional<double> resolution_m = {});

  ServerStatus status(bool with_counts = false);

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace nbvopt
