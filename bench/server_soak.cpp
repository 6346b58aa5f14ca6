#include "bench/server_soak.hpp"

#include <grpcpp/grpcpp.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/formatted.hpp"
#include "bench/latencies.hpp"
#include "bench/resident_memory.hpp"
#include "bench/soak_model.hpp"
#include "bench/soak_world.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/v1/planner.grpc.pb.h"
#include "support/paths.hpp"
#include "support/server_process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr double kResolution_m = 0.05;

// The server's limits, MiB, and what they allow it to take.
constexpr int kMaxMap = 256;
constexpr int kMaxPinned = 32;
constexpr int kMaxBuffered = 64;
constexpr int kMarks = 81;  // of a scan that is being inserted
constexpr int kMostReaders = 20;
constexpr int kOfReader = 2;
constexpr double kAllowed =
    1.1 * (kMaxMap + kMaxPinned + 2 * kMaxBuffered + kMarks + kMostReaders * kOfReader);

class Soak {
 public:
  explicit Soak(std::uint64_t seed) : random_(seed) { start(); }

  void run_until(Clock::time_point end) {
    while (Clock::now() < end) {
      const Event& event = draw();
      try {
        event.run(*this);
        check_memory();
      } catch (const std::exception& error) {
        throw std::runtime_error(
            formatted("event %llu, %s: ", static_cast<unsigned long long>(events_), event.name) +
            error.what());
      }
      ++events_;
      ++counts_[event.name];
    }
    compare_maps();
  }

  std::string report() const {
    std::string text = "| event | times |\n| --- | ---: |\n";
    for (const auto& [name, count] : counts_)
      text += formatted("| %s | %d |\n", name.c_str(), count);
    return text + "\n" + Latencies::header() + scans_.row("a scan") + plans_.row("a plan") +
           formatted("\nResident at most %.0f MB beyond the %.0f MB of an empty server, of %.0f.\n",
                     most_resident_mb_ - empty_mb_, empty_mb_, kAllowed);
  }

 private:
  struct Event {
    const char* name;
    double weight;
    void (*run)(Soak&);
  };

  static const std::vector<Event>& events() {
    static const std::vector<Event> all{
        {"a scan", 60.0, [](Soak& s) { s.insert(soak_scan(s.random_)); }},
        {"a plan", 60.0, [](Soak& s) { s.plan(); }},
        {"the map compared", 6.0, [](Soak& s) { s.compare_maps(); }},
        {"another client", 4.0, [](Soak& s) { s.client_.emplace(s.server_->address()); }},
        {"a scan cancelled", 4.0, [](Soak& s) { s.cancel_scan(); }},
        {"a scan of all directions", 1.0, [](Soak& s) { s.insert(soak_sphere(s.random_)); }},
        {"a reader that stalls", 2.0, [](Soak& s) { s.stall(); }},
        {"the map saved and loaded", 1.0, [](Soak& s) { s.save_and_load(); }},
        {"the map cleared", 0.2, [](Soak& s) { s.clear(); }},
        {"the server stopped for a while", 0.5, [](Soak& s) { s.stop_for_a_while(); }},
        {"a full disk", 0.5, [](Soak& s) { s.fill_disk(); }},
        {"the server ended", 0.5, [](Soak& s) { s.end(); }},
        {"the server killed", 1.0, [](Soak& s) { s.kill(); }},
        {"the server killed in a scan", 1.0, [](Soak& s) { s.kill_in_a_scan(); }},
    };
    return all;
  }

  const Event& draw() {
    std::vector<double> weights;
    for (const Event& event : events()) weights.push_back(event.weight);
    std::discrete_distribution<std::size_t> which(weights.begin(), weights.end());
    return events()[which(random_)];
  }

  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  // The server

  void start() {
    server_.emplace(test::cli_program(),
                    std::vector<std::string>{"serve",
                                             "--create",
                                             std::to_string(kResolution_m),
                                             "--snapshot",
                                             folder_ / "snapshot.ot",
                                             "--snapshot-every",
                                             "0.2",
                                             "--data-dir",
                                             folder_ / "",
                                             "--listen",
                                             "unix:" + (folder_ / "socket"),
                                             "--max-map-mib",
                                             std::to_string(kMaxMap),
                                             "--max-pinned-mib",
                                             std::to_string(kMaxPinned),
                                             "--max-buffered-mib",
                                             std::to_string(kMaxBuffered),
                                             "--max-send",
                                             "1",
                                             "--threads",
                                             "1"},
                    folder_ / "log");
    client_.emplace(server_->address());
    if (empty_mb_ == 0.0) empty_mb_ = resident_mb(server_->process().id());
    model_.come_back_with(client_->status().map_version);
    compare_maps();
  }

  void kill() {
    readers_.clear();
    server_->process().send(SIGKILL);
    server_->process().wait();
    start();
  }

  void kill_in_a_scan() {
    const Scan scan = soak_scan(random_);
    const Transform T_map_sensor = soak_pose(random_);
    std::jthread killer(
        [&, delay = std::chrono::microseconds(static_cast<int>(uniform(0.0, 30e3)))] {
          std::this_thread::sleep_for(delay);
          server_->process().send(SIGKILL);
        });
    try {
      told(client_->insert_scan(scan, T_map_sensor));
    } catch (const ServerError&) {  // whether it is in the map shows when the server is back
    }
    model_.apply(insertion(scan, T_map_sensor));
    killer.join();
    kill();
  }

  void end() {
    readers_.clear();
    server_->process().send(SIGTERM);
    require(server_->process().wait() == 0, "the server did not end well");
    model_.make_durable(model_.version());
    start();
  }

  void stop_for_a_while() {
    server_->process().send(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(uniform(10.0, 500.0))));
    server_->process().send(SIGCONT);
    plan();
  }

  /// A limit of the size of files stands for a full disk.
  void fill_disk() {
    const auto limit = [this](rlim_t bytes) {
      rlimit now{};
      ::prlimit(server_->process().id(), RLIMIT_FSIZE, nullptr, &now);
      now.rlim_cur = bytes;
      ::prlimit(server_->process().id(), RLIMIT_FSIZE, &now, nullptr);
    };
    limit(100);
    insert(soak_scan(random_));
    wait_until([this] { return !client_->status().snapshot_error.empty(); }, "no word of it");
    try {
      client_->save_map("saved.ot");
      throw std::runtime_error("a map was saved on a full disk");
    } catch (const ServerError& error) {
      require(error.kind() == ServerErrorKind::not_saved, error.what());
    }
    insert(soak_scan(random_));
    limit(RLIM_INFINITY);
    wait_until([this] { return client_->status().durable_version == model_.version(); },
               "nothing is durable after it");
    model_.make_durable(model_.version());
  }

  // Its clients

  void plan() {
    PlanRequest request;
    request.T_map_base = soak_base(random_);
    request.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
    request.motion_time_s = 0.5;
    request.stop.deadline = Clock::now() + 50ms;
    const auto begin = Clock::now();
    const RemotePlan answer = client_->plan(request);
    plans_.add(milliseconds_since(begin));
    require(answer.result.map_version == model_.version(), "a plan on another version");
  }

  void insert(const Scan& scan) {
    const Transform T_map_sensor = soak_pose(random_);
    const auto begin = Clock::now();
    try {
      const ScanReceipt receipt = client_->insert_scan(scan, T_map_sensor);
      scans_.add(milliseconds_since(begin));
      model_.apply(insertion(scan, T_map_sensor));
      require(receipt.map_version == model_.version(), "a scan in another version");
      told(receipt);
    } catch (const ServerError& error) {  // it would have taken too much memory
      require(error.kind() == ServerErrorKind::bad_request, error.what());
      require(client_->status().map_version == model_.version(), "a refused scan is in the map");
    }
  }

  void cancel_scan() {
    const Scan scan = random_() % 2 == 0 ? soak_scan(random_) : soak_sphere(random_);
    const Transform T_map_sensor = soak_pose(random_);
    PlannerClient hasty(server_->address(), {},
                        std::chrono::milliseconds(static_cast<int>(uniform(1.0, 40.0))));
    try {
      told(hasty.insert_scan(scan, T_map_sensor));
    } catch (const ServerError&) {  // in the map or not
    }
    // Scans are inserted one after the other: once this one is, the other is decided.
    const Scan next = soak_scan(random_);
    const Transform next_pose = soak_pose(random_);
    const ScanReceipt receipt = client_->insert_scan(next, next_pose);
    if (receipt.map_version == model_.version() + 2) model_.apply(insertion(scan, T_map_sensor));
    model_.apply(insertion(next, next_pose));
    require(receipt.map_version == model_.version(), "a scan in another version");
    told(receipt);
    compare_maps();
  }

  void compare_maps() {
    const RemoteMap map = newest_map();
    require(map.map_version == model_.version(), "a map of another version");
    require(map.bytes == model_.bytes(), "the map is not that of the model");
  }

  /// Asked for again while other readers hold too much.
  RemoteMap newest_map() {
    for (int i = 0;; ++i) {
      try {
        return client_->get_map();
      } catch (const ServerError& error) {
        if (error.kind() != ServerErrorKind::busy || i == 1000) throw;
        std::this_thread::sleep_for(10ms);
      }
    }
  }

  void save_and_load() {
    require(client_->save_map("saved.ot") == model_.version(), "another version was saved");
    require(client_->load_map("saved.ot") == model_.version() + 1, "the version did not grow");
    model_.apply([](UncertaintyMap&) {});
    compare_maps();
  }

  void clear() {
    require(client_->clear_map() == model_.version() + 1, "the version did not grow");
    model_.apply([](UncertaintyMap& map) { map = UncertaintyMap(kResolution_m); });
  }

  /// A client that takes the beginning of the map; some of them stay for a while.
  struct Reader {
    std::unique_ptr<v1::Planner::Stub> stub;
    grpc::ClientContext context;
    std::unique_ptr<grpc::ClientReader<v1::MapChunk>> stream;
    ~Reader() {
      context.TryCancel();
      if (stream != nullptr) stream->Finish();
    }
  };

  void stall() {
    Reader& reader = readers_.emplace_back();
    grpc::ChannelArguments own_connection;
    own_connection.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    reader.stub = v1::Planner::NewStub(grpc::CreateCustomChannel(
        server_->address(), grpc::InsecureChannelCredentials(), own_connection));
    reader.stream = reader.stub->GetMap(&reader.context, {});
    v1::MapChunk chunk;
    reader.stream->Read(&chunk);
    if (readers_.size() > kMostReaders) readers_.pop_front();
  }

  // What they know

  void told(const ScanReceipt& receipt) {
    durable_ = receipt.durable_version;
    make_durable();
  }
  void make_durable() {
    if (durable_ > model_.durable_version() && durable_ <= model_.version()) {
      model_.make_durable(durable_);
    }
  }

  SoakModel::Change insertion(const Scan& scan, const Transform& T_map_sensor) const {
    return [scan, T_map_sensor, sensor = Robot().sensor](UncertaintyMap& map) {
      insert_scan(map, scan, T_map_sensor, sensor);
    };
  }

  void check_memory() {
    const double now_mb = resident_mb(server_->process().id());
    most_resident_mb_ = std::max(most_resident_mb_, now_mb);
    require(now_mb - empty_mb_ <= kAllowed,
            formatted("%.0f MB are resident, %.0f of an empty server", now_mb, empty_mb_));
  }

  static void require(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error(what);
  }

  template <typename Ask>
  void wait_until(const Ask& ask, const char* otherwise) {
    const auto end = Clock::now() + 30s;
    while (!ask()) {
      require(Clock::now() < end, otherwise);
      std::this_thread::sleep_for(5ms);
    }
  }

  static double milliseconds_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  }

  std::mt19937_64 random_;
  test::TemporaryFolder folder_;
  SoakModel model_{kResolution_m, 1};
  std::optional<test::ServerProcess> server_;
  std::optional<PlannerClient> client_;
  std::list<Reader> readers_;
  std::uint64_t durable_ = 0;  ///< as a scan's reply has told
  std::uint64_t events_ = 0;
  std::map<std::string, int> counts_;
  Latencies scans_;
  Latencies plans_;
  double empty_mb_ = 0.0;
  double most_resident_mb_ = 0.0;
};

}  // namespace

std::string soak_server(double minutes, std::uint64_t seed) {
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(minutes * std::chrono::minutes(1));
  try {
    Soak soak(seed);
    soak.run_until(end);
    return formatted("%.1f minutes of scans, plans and faults, seed %llu:\n\n", minutes,
                     static_cast<unsigned long long>(seed)) +
           soak.report();
  } catch (const std::exception& error) {
    throw std::runtime_error("soak, seed " + std::to_string(seed) + ": " + error.what());
  }
}

}  // namespace nbvopt::bench
