// Who gets in, and who keeps nobody out.
#include "server/acceptor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <mutex>

#include "nbvopt/core/error.hpp"
#include "server/listening_socket.hpp"
#include "support/error_message.hpp"
#include "support/sanitizers.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;

/// The process may open no more files while this lives.
class NoMoreDescriptors {
 public:
  NoMoreDescriptors() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const Descriptor next(::dup(0));
    const rlimit now{static_cast<rlim_t>(next.get()), before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &now);
  }
  NoMoreDescriptors(const NoMoreDescriptors&) = delete;
  NoMoreDescriptors& operator=(const NoMoreDescriptors&) = delete;
  ~NoMoreDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

/// An acceptor that keeps what is handed over.
class AcceptorTest : public ::testing::Test {
 protected:
  void start(SocketBudget budget) {
    acceptor.emplace(listen_on(address), budget, log,
                     Acceptor::Hooks{.hand_over =
                                         [this](int connection, int) {
                                           const std::scoped_lock lock(mutex);
                                           taken.emplace_back(connection);
                                         },
                                     .on_room = [this](bool room) { has_room = room; }});
  }

  /// A client's socket, not connected yet.
  static Descriptor new_client() { return Descriptor(::socket(AF_UNIX, SOCK_STREAM, 0)); }

  bool connects(const Descriptor& client) const {
    sockaddr_un where{};
    where.sun_family = AF_UNIX;
    address.socket->string().copy(where.sun_path, sizeof(where.sun_path) - 1);
    return ::connect(client.get(), reinterpret_cast<sockaddr*>(&where), sizeof(where)) == 0;
  }

  Descriptor connected() const {
    Descriptor client = new_client();
    EXPECT_TRUE(connects(client));
    return client;
  }

  static void speak(const Descriptor& client) { ::send(client.get(), "x", 1, MSG_NOSIGNAL); }

  Descriptor speaking() const {
    Descriptor client = connected();
    speak(client);
    return client;
  }

  /// Whether the other end is closed; waits for nothing.
  static bool is_closed(const Descriptor& client) {
    char byte = 0;
    return ::recv(client.get(), &byte, 1, MSG_DONTWAIT) == 0 || errno == ECONNRESET;
  }

  std::size_t taken_count() {
    const std::scoped_lock lock(mutex);
    return taken.size();
  }

  void close_all_taken() {
    const std::scoped_lock lock(mutex);
    taken.clear();
  }

  test::TemporaryFolder folder;
  ListenAddress address = parse_listen_address("unix:" + (folder / "socket"));
  ConnectionLog log;
  std::atomic<bool> has_room{true};
  std::mutex mutex;
  std::vector<Descriptor> taken;
  std::optional<Acceptor> acceptor;
};

TEST_F(AcceptorTest, HandsOverWhoSpeaks) {
  start({.connections = 4, .silent = 4});
  const Descriptor silent = connected();
  const Descriptor client = speaking();
  ASSERT_TRUE(test::wait_until([&] { return taken_count() == 1; }));
  char byte = 0;
  EXPECT_EQ(::recv(taken.front().get(), &byte, 1, 0), 1);
  EXPECT_EQ(byte, 'x');  // nothing is lost on the way
  EXPECT_EQ(log.open, 1U);
  speak(silent);
  EXPECT_TRUE(test::wait_until([&] { return taken_count() == 2; }));
}

TEST_F(AcceptorTest, SilentOnesKeepNobodyOut) {
  start({.connections = 2, .silent = 3});
  std::vector<Descriptor> silent;
  for (int i = 0; i < 20; ++i) silent.push_back(connected());
  const Descriptor client = speaking();
  EXPECT_TRUE(test::wait_until([&] { return taken_count() == 1; }));
  EXPECT_TRUE(test::wait_until([&] { return is_closed(silent.front()); }));
  EXPECT_FALSE(is_closed(silent.back()));
  EXPECT_GE(log.silent, 17U);
  EXPECT_TRUE(has_room);
}

TEST_F(AcceptorTest, WhoEndsBeforeItSpeaksIsForgotten) {
  start({.connections = 2, .silent = 3});
  for (int i = 0; i < 3; ++i) connected();
  EXPECT_TRUE(test::wait_until([&] { return log.silent == 3; }));
}

TEST_F(AcceptorTest, RefusesMoreThanItMayHoldUntilOneIsGone) {
  start({.connections = 2, .silent = 3});
  const Descriptor first = speaking();
  const Descriptor second = speaking();
  ASSERT_TRUE(test::wait_until([&] { return taken_count() == 2 && !has_room; }));
  const Descriptor third = speaking();
  EXPECT_TRUE(test::wait_until([&] { return is_closed(third); }));
  EXPECT_EQ(log.refused, 1U);
  close_all_taken();
  EXPECT_TRUE(test::wait_until([&] { return has_room.load(); }));
  EXPECT_EQ(log.open, 0U);
  const Descriptor fourth = speaking();
  EXPECT_TRUE(test::wait_until([&] { return taken_count() == 1; }));
}

TEST_F(AcceptorTest, HearsAgainWhenDescriptorsAreBack) {
  if (test::kAddressSanitizer) GTEST_SKIP() << "the sanitizer looks at memory by descriptors";
  start({.connections = 4, .silent = 4});
  const Descriptor client = new_client();
  {
    const NoMoreDescriptors limit;
    EXPECT_TRUE(connects(client));
    speak(client);
    EXPECT_TRUE(test::wait_until([&] { return !has_room; }));
  }
  EXPECT_TRUE(test::wait_until([&] { return taken_count() == 1; }));
  EXPECT_TRUE(test::wait_until([&] { return has_room.load(); }));
}

TEST_F(AcceptorTest, WhenItHasStoppedNobodyGetsIn) {
  start({.connections = 4, .silent = 4});
  const Descriptor silent = connected();
  acceptor->stop();
  EXPECT_TRUE(is_closed(silent));
  EXPECT_FALSE(connects(new_client()));
}

TEST(SocketBudget, KeepsDescriptorsForFiles) {
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(socket_budget(5).connections, 5U);
  const auto used = static_cast<rlim_t>(Descriptor(::dup(0)).get());
  rlimit low{used + 100, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &low);
  const SocketBudget budget = socket_budget(1000);
  EXPECT_GT(budget.connections, 0U);
  EXPECT_GT(budget.silent, 0U);
  EXPECT_LE(budget.connections + budget.silent, 70U);
  low.rlim_cur = used + 20;
  ::setrlimit(RLIMIT_NOFILE, &low);
  EXPECT_THAT(test::message_of<UsageError>([] { socket_budget(1000); }), HasSubstr("ulimit -n"));
  ::setrlimit(RLIMIT_NOFILE, &before);
}

TEST(ListeningSockets, FillInThePortThatTheSystemChose) {
  for (const char* host : {"127.0.0.1", "[::1]", "localhost"}) {
    ListenAddress address = parse_listen_address(std::string(host) + ":0");
    std::vector<Descriptor> sockets;
    try {
      sockets = listen_on(address);
    } catch (const InputError&) {
      continue;  // a machine without IPv6
    }
    EXPECT_THAT(address.text, ::testing::MatchesRegex(".*:[1-9][0-9]*"));
    ListenAddress same = parse_listen_address(address.text);
    EXPECT_THAT(test::message_of<InputError>([&] { listen_on(same); }),
                HasSubstr("cannot listen on " + address.text + ": Address already in use"));
  }
  ListenAddress foreign = parse_listen_address("192.0.2.1:0");  // of documentation
  EXPECT_THAT(test::message_of<InputError>([&] { listen_on(foreign); }),
              HasSubstr("Cannot assign requested address"));
}

}  // namespace
}  // namespace nbvopt
