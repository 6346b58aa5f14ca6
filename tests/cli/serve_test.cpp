// nbvopt serve, as its users start, stop and kill it.
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "cli/query_command.hpp"
#include "cli/served.hpp"
#include "core/descriptor.hpp"
#include "nbvopt/map/map_file.hpp"
#include "server/snapshot_file.hpp"
#include "support/notify_socket.hpp"
#include "support/paths.hpp"
#include "support/sanitizers.hpp"
#include "support/wait_for_search.hpp"
#include "support/wait_until.hpp"

namespace nbvopt::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Serve : public ::testing::Test {
 protected:
  /// What /bin/sh runs to start a server under a limit or in an environment of its own.
  std::vector<std::string> after(const std::string& first,
                                 const std::vector<std::string>& more = {}) const {
    std::string command = first + "; exec '" + cli_program() + "'";
    for (const std::string& word : server.arguments(more)) command += " '" + word + "'";
    return {"-c", command};
  }

  ServerFolder server;
};

TEST_F(Serve, EndsOnSignalsWithItsMapSaved) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    Served served(server, server.arguments({"--snapshot-every", "3600"}));
    PlannerClient client(served.address());
    const std::uint64_t version = client.insert_scan(small_scan(), scan_pose(signal)).map_version;
    const std::string bytes = client.get_map().bytes;
    served.process().send(signal);
    EXPECT_EQ(served.process().wait(), 0);
    const auto snapshot = read_snapshot(server.snapshot());
    EXPECT_EQ(snapshot->version, version);
    EXPECT_EQ(map_file_bytes(snapshot->map, MapFormat::uncertainty_ot), bytes);
    EXPECT_THAT(server.log(), HasSubstr("event=stopped"));
  }
}

TEST_F(Serve, TakesAllDescriptorsThatItMayHave) {
  Served served(server, server.arguments());
  rlimit limit{};
  ASSERT_EQ(::prlimit(served.process().id(), RLIMIT_NOFILE, nullptr, &limit), 0);
  EXPECT_EQ(limit.rlim_cur, limit.rlim_max);
}

/// A client that connects and says nothing.
Descriptor silent_client(const std::string& path) {
  Descriptor client(::socket(AF_UNIX, SOCK_STREAM, 0));
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  path.copy(where.sun_path, sizeof(where.sun_path) - 1);
  EXPECT_EQ(::connect(client.get(), reinterpret_cast<sockaddr*>(&where), sizeof(where)), 0);
  return client;
}

TEST_F(Serve, ServesWhileAndAfterSilentClientsTakeAllDescriptors) {
  const Served served(server, after("ulimit -n 100", {"--snapshot-every", "0.01"}), "/bin/sh");
  {
    std::vector<Descriptor> silent;
    for (int i = 0; i < 300; ++i) silent.push_back(silent_client(server.folder / "socket"));
    PlannerClient client(served.address());
    const std::uint64_t version = client.insert_scan(small_scan(), scan_pose(0)).map_version;
    EXPECT_TRUE(wait_until([&] { return client.status().durable_version == version; }));
    EXPECT_GT(client.status().connections_silent, 200U);
  }
  EXPECT_EQ(PlannerClient(served.address()).status().connections_refused, 0U);
}

TEST_F(Serve, TellsItsServiceManagerHowItIs) {
  const std::string name = server.folder / "notify";
  const NotifySocket heard(name);
  Served served(server, after("export NOTIFY_SOCKET='" + name + "' WATCHDOG_USEC=200000"),
                "/bin/sh");
  EXPECT_EQ(heard.next(), "READY=1");
  EXPECT_EQ(PlannerClient(served.address()).status().map_version, 1U);  // it is
  EXPECT_EQ(heard.next(), "WATCHDOG=1");
  EXPECT_EQ(heard.next(), "WATCHDOG=1");
  served.process().send(SIGTERM);
  std::string last = heard.next();
  while (last == "WATCHDOG=1") last = heard.next();
  EXPECT_EQ(last, "STOPPING=1");
  EXPECT_EQ(served.process().wait(), 0);
  EXPECT_THAT(server.log(), Not(HasSubstr("does_not_answer")));
}

TEST_F(Serve, CancelsWhatIsInFlightWhenItEnds) {
  Served served(server, server.arguments({"--max-compute-ms", "1e9"}));
  std::atomic<bool> has_answered = false;
  std::jthread caller([&] {
    PlannerClient client(served.address(), {}, 10min);
    PlanRequest request = small_request();
    request.stop.max_evaluations = 1'000'000'000'000;  // days
    EXPECT_THROW(client.plan(request, {.solver = "random"}), ServerError);
    has_answered = true;
  });
  EXPECT_TRUE(wait_for_search(served.process().id()));
  EXPECT_FALSE(has_answered);
  served.process().send(SIGTERM);
  EXPECT_TRUE(wait_until([&] { return served.process().has_ended(); }));
  served.process().send(SIGKILL);  // or the caller would wait for days
  EXPECT_EQ(served.process().wait(), 0);
}

/// What the map is at each version, when scan_pose(v) is inserted into version v.
class KnownVersions {
 public:
  const std::string& bytes(std::uint64_t version) {
    while (bytes_.size() < version) {
      insert_scan(map_, small_scan(), scan_pose(static_cast<int>(bytes_.size())),
                  small_robot().sensor);
      bytes_.push_back(map_file_bytes(map_, MapFormat::uncertainty_ot));
    }
    return bytes_[version - 1];
  }

 private:
  UncertaintyMap map_{0.1};
  std::vector<std::string> bytes_{map_file_bytes(map_, MapFormat::uncertainty_ot)};
};

TEST_F(Serve, LosesNothingThatItCalledDurableWhenItIsKilled) {
  constexpr int kKills = 50;
  std::mt19937_64 random(3);
  KnownVersions known;
  std::uint64_t told = 0;
  std::uint64_t run_id = 0;
  int lost_scans = 0;
  for (int i = 0; i < kKills; ++i) {
    if (i % 5 == 4) {  // while it starts
      BackgroundProcess starting(cli_program(), server.arguments(), server.folder / "log");
      std::this_thread::sleep_for(std::chrono::microseconds(uniform_int(random, 0, 150'000)));
      starting.send(SIGKILL);
      starting.wait();
      const auto snapshot = read_snapshot(server.snapshot());
      EXPECT_GE(snapshot->version, told);
      continue;
    }
    Served served(server, server.arguments({"--snapshot-every", "0.003"}));
    std::uint64_t version = 0;
    std::jthread killer([&, delay = std::chrono::microseconds(uniform_int(random, 0, 60'000))] {
      std::this_thread::sleep_for(delay);
      served.process().send(SIGKILL);
    });
    std::uint64_t this_run_id = run_id;
    try {
      PlannerClient client(served.address());
      version = client.status().map_version;
      EXPECT_GE(version, told);
      while (true) {
        const ScanReceipt receipt =
            client.insert_scan(small_scan(), scan_pose(static_cast<int>(version)));
        EXPECT_EQ(receipt.map_version, version + 1);
        EXPECT_NE(receipt.run_id, run_id);
        version = receipt.map_version;
        this_run_id = receipt.run_id;
        told = std::max(told, receipt.durable_version);
      }
    } catch (const ServerError&) {  // it was killed
    }
    killer.join();
    served.process().wait();
    run_id = this_run_id;
    const auto snapshot = read_snapshot(server.snapshot());
    ASSERT_TRUE(snapshot);
    EXPECT_GE(snapshot->version, told);
    EXPECT_EQ(map_file_bytes(snapshot->map, MapFormat::uncertainty_ot),
              known.bytes(snapshot->version));
    if (snapshot->version < version) ++lost_scans;
  }
  EXPECT_GT(told, 1U);
  EXPECT_GT(lost_scans, 0);  // else the server was never killed at an inconvenient moment
}

TEST_F(Serve, SaysWhenTheDiskIsFullAndGoesOn) {
  // The largest file that it may write: 4 blocks of 512 bytes.
  Served served(server, after("ulimit -f 4", {"--snapshot-every", "0.01"}), "/bin/sh");
  PlannerClient client(served.address());
  EXPECT_EQ(client.status().durable_version, 1U);
  client.insert_scan(small_scan(), scan_pose(0));
  EXPECT_TRUE(wait_until([&] { return !client.status().snapshot_error.empty(); }));
  EXPECT_THAT(client.status().snapshot_error, HasSubstr("File too large"));
  EXPECT_EQ(client.insert_scan(small_scan(), scan_pose(1)).durable_version, 1U);
  EXPECT_EQ(client.plan(small_request()).result.map_version, 3U);
  EXPECT_EQ(read_snapshot(server.snapshot())->version, 1U);
  EXPECT_THROW(client.clear_map(-1.0), ServerError);
  served.process().send(SIGTERM);
  EXPECT_EQ(served.process().wait(), 3);  // its map could not be saved
  EXPECT_EQ(read_snapshot(server.snapshot())->version, 1U);
}

TEST_F(Serve, SharesNeitherSocketNorSnapshot) {
  const Served served(server, server.arguments());
  expect_refusal(nbvopt_run(server.arguments()), 3, "another server uses this socket");
  std::vector<std::string> elsewhere = server.arguments();
  elsewhere.back() = "127.0.0.1:0";
  expect_refusal(nbvopt_run(elsewhere), 3, "another server uses this snapshot");
  EXPECT_EQ(PlannerClient(served.address()).status().map_version, 1U);
}

TEST_F(Serve, RefusesWhatItCannotStartWith) {
  expect_refusal(nbvopt_run({"serve"}), 2, "--create");
  expect_refusal(nbvopt_run({"serve", "--create", "0.1", "--listen", "0.0.0.0:0"}), 2,
                 "certificate");
  expect_refusal(nbvopt_run({"serve", "--create", "0.1", "--listen", "here"}), 2, "HOST:PORT");
  expect_refusal(nbvopt_run({"serve", "--create", "0"}), 3, "positive");
  expect_refusal(run_process("/bin/sh", after("ulimit -n 24")), 2, "open files");
  expect_refusal(nbvopt_run({"serve", "--create", "1e-4"}), 3, "min_resolution_m");
  expect_refusal(nbvopt_run({"serve", "none.ot"}), 3, "none.ot");
  expect_refusal(nbvopt_run({"serve", "--create", "0.1", "--data-dir", "/none"}), 3, "data folder");
  expect_refusal(nbvopt_run({"serve", "--create", "0.1", "--snapshot", "/none/s.ot"}), 3, "/none");
  expect_refusal(nbvopt_run({"serve", "--create", "0.1", "--snapshot-every", "0"}), 3,
                 "--snapshot-every");
  server.folder.write("snapshot.ot", "not a map");
  expect_refusal(nbvopt_run(server.arguments()), 3, "snapshot.ot");
}

TEST_F(Serve, GoesOnWhenTheClockJumps) {
  if (kAddressSanitizer) GTEST_SKIP() << "a preloaded library must come before the sanitizer's";
  const char* fake = "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1";
  if (!std::filesystem::exists(fake)) GTEST_SKIP() << "libfaketime is not installed";
  const std::string offset = server.folder.write("offset", "+0");
  std::vector<std::string> arguments{std::string("LD_PRELOAD=") + fake,
                                     "FAKETIME_TIMESTAMP_FILE=" + offset, "FAKETIME_NO_CACHE=1",
                                     "FAKETIME_DONT_FAKE_MONOTONIC=1", cli_program()};
  for (const std::string& argument :
       server.arguments({"--snapshot-every", "0.05", "--log-level", "debug"})) {
    arguments.push_back(argument);
  }
  Served served(server, arguments, "/usr/bin/env");
  PlannerClient client(served.address());
  int scans = 0;
  for (const char* jump : {"+3600", "-3600", "+366d", "+0"}) {
    server.folder.write("offset.new", jump);
    std::filesystem::rename(server.folder / "offset.new", offset);
    for (int i = 0; i < 3; ++i) {
      const std::uint64_t version =
          client.insert_scan(small_scan(), scan_pose(scans++)).map_version;
      EXPECT_NE(client.plan(small_request()).result.status, PlanStatus::time_limit) << jump;
      EXPECT_TRUE(wait_until([&] { return client.status().durable_version >= version; }));
    }
  }
  // The log was written in more than one year: the jumps have reached the server.
  const std::string log = server.log();
  EXPECT_NE(log.find("\n" + std::to_string(std::stoi(log.substr(0, 4)) + 1)), std::string::npos);
  served.process().send(SIGTERM);
  EXPECT_EQ(served.process().wait(), 0);
}

/// Keys and certificates of a test, made by OpenSSL.
class Certificates {
 public:
  explicit Certificates(const TemporaryFolder& folder) : folder_(folder) {
    for (const char* ca : {"ca", "other_ca"}) {
      run({"req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
           "-subj", "/CN=test", "-keyout", file(ca, ".key"), "-out", file(ca, ".pem")});
    }
    sign("server", "ca");
    sign("client", "ca");
    sign("stranger", "other_ca");
  }

  std::string file(const std::string& name, const char* extension) const {
    return folder_ / (name + extension);
  }

 private:
  void sign(const char* name, const char* ca) const {
    const std::string san = folder_.write("san", "subjectAltName=DNS:localhost");
    run({"req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj",
         "/CN=localhost", "-keyout", file(name, ".key"), "-out", file(name, ".csr")});
    run({"x509", "-req", "-in", file(name, ".csr"), "-CA", file(ca, ".pem"), "-CAkey",
         file(ca, ".key"), "-CAcreateserial", "-extfile", san, "-out", file(name, ".pem")});
  }

  static void run(const std::vector<std::string>& arguments) {
    const ProcessResult result = run_process("/usr/bin/openssl", arguments);
    if (result.exit_code != 0) throw std::runtime_error(result.err);
  }

  const TemporaryFolder& folder_;
};

TEST_F(Serve, LetsOnlyThoseInFromElsewhereWhoHaveACertificate) {
  const Certificates made(server.folder);
  std::vector<std::string> arguments =
      server.arguments({"--tls-cert", made.file("server", ".pem"), "--tls-key",
                        made.file("server", ".key"), "--tls-client-ca", made.file("ca", ".pem")});
  *std::find(arguments.begin(), arguments.end(), server.socket()) = "0.0.0.0:0";
  const Served served(server, arguments);
  const std::string address = "localhost" + served.address().substr(served.address().rfind(':'));
  const auto tls = [&](const char* name) {
    return ClientTls{.server_ca = made.file("ca", ".pem"),
                     .certificate = made.file(name, ".pem"),
                     .key = made.file(name, ".key")};
  };
  EXPECT_EQ(PlannerClient(address, tls("client")).status().map_version, 1U);
  EXPECT_THROW(PlannerClient(address, {}, 2s).status(), ServerError);
  EXPECT_THROW(PlannerClient(address, tls("stranger"), 2s).status(), ServerError);
  const ProcessResult asked =
      nbvopt_run({"query", "--server", address, "--base", "0,0,0", "--height", "0.4",
                  "--motion-time", "0.5", "--tls-ca", made.file("ca", ".pem"), "--tls-cert",
                  made.file("client", ".pem"), "--tls-key", made.file("client", ".key")});
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
}

TEST_F(Serve, AnswersQueriesToTheLastBit) {
  const std::string map = datasets_dir() / "office_partial.ot";
  const Served served(server, {"serve", map, "--gain", "positive", "--listen", server.socket()});
  for (const Arguments& more :
       {Arguments{}, Arguments{"--seed", "7", "--solver", "nlopt:crs2", "--max-evals", "200"},
        Arguments{"--base-velocity", "0.2,0,0.3"}, Arguments{"--solver", "grid"},
        Arguments{"--global", "none", "--tilt", "0.795"}, Arguments{"--min-gain", "1e9"}}) {
    Arguments shared{"--base", "1.9,2.6,1.57", "--height", "0.4", "--motion-time", "0.5", "--json"};
    shared.insert(shared.end(), more.begin(), more.end());
    Arguments here{"query", map};
    Arguments there{"query", "--server", served.address()};
    for (Arguments* arguments : {&here, &there}) {
      arguments->insert(arguments->end(), shared.begin(), shared.end());
    }
    json local = without_times(json::parse(nbvopt_run(here).out));
    json remote = without_times(json::parse(nbvopt_run(there).out));
    for (const char* key : {"server", "call_ms", "map_version"}) EXPECT_EQ(remote.erase(key), 1U);
    EXPECT_EQ(local, remote);
  }
}

TEST_F(Serve, IsAskedWithOneClearLineWhenThatFails) {
  const std::vector<std::string> query{"query", "--base", "0,0,0", "--motion-time", "0.5"};
  const auto asked = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = query;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nbvopt_run(arguments);
  };
  expect_refusal(asked({}), 2, "--server");
  expect_refusal(asked({"--server", server.socket()}), 2, "--height");
  expect_refusal(asked({"m.ot", "--server", server.socket(), "--height", "0.4"}), 2, "not both");
  expect_refusal(asked({"--server", server.socket(), "--height", "0.4", "--plot", "p.png"}), 2,
                 "--plot");
  expect_refusal(asked({"--server", server.socket(), "--height", "0.4"}), 3,
                 "no server answers there");
  const Served served(server, server.arguments());
  expect_refusal(asked({"--server", server.socket(), "--height", "1.4"}), 3, "height is 1.4 m");
}

}  // namespace
}  // namespace nbvopt::test
