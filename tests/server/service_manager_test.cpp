// What a service manager hears: the test is one.
#include "server/service_manager.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>

#include "server/running_server.hpp"
#include "support/notify_socket.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

using namespace std::chrono_literals;

TEST(ServiceManager, HearsOnPathsAndOnAbstractSockets) {
  const test::TemporaryFolder folder;
  for (const std::string& name :
       {folder / "notify", "@nbvopt-test-" + std::to_string(::getpid())}) {
    const test::NotifySocket heard(name);
    ServiceManager(name).notify("READY=1");
    EXPECT_EQ(heard.next(), "READY=1");
  }
}

TEST(ServiceManager, NeedNotBeThere) {
  ServiceManager("").notify("READY=1");
  ServiceManager("/no/such/socket").notify("READY=1");
  ServiceManager(std::string(1000, 'x')).notify("READY=1");
}

TEST(ServiceManager, IsNamedByTheEnvironment) {
  const test::TemporaryFolder folder;
  const test::NotifySocket heard(folder / "notify");
  ::setenv("NOTIFY_SOCKET", (folder / "notify").c_str(), 1);
  ::setenv("WATCHDOG_USEC", "2000000", 1);
  EXPECT_EQ(ServiceManager::from_environment().watchdog(), 2s);
  ::setenv("WATCHDOG_PID", "1", 1);  // somebody else's
  EXPECT_FALSE(ServiceManager::from_environment().watchdog());
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  EXPECT_EQ(ServiceManager::from_environment().watchdog(), 2s);
  ::setenv("WATCHDOG_USEC", "soon", 1);
  const ServiceManager manager = ServiceManager::from_environment();
  EXPECT_FALSE(manager.watchdog());
  manager.notify("STOPPING=1");
  EXPECT_EQ(heard.next(), "STOPPING=1");
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
}

TEST(Heartbeat, BeatsWhileTheServerIsAlive) {
  const test::TemporaryFolder folder;
  const test::NotifySocket heard(folder / "notify");
  const ServiceManager manager(folder / "notify", 20ms);
  std::atomic<bool> is_alive{true};
  std::atomic<int> asked{0};
  const Heartbeat heartbeat(manager, [&](std::chrono::milliseconds timeout) {
    EXPECT_EQ(timeout, 5ms);
    ++asked;
    return is_alive.load();
  });
  EXPECT_EQ(heard.next(), "WATCHDOG=1");
  EXPECT_EQ(heard.next(), "WATCHDOG=1");
  is_alive = false;
  // What was asked before may still be on its way.
  for (const int before = asked; asked < before + 2;) std::this_thread::sleep_for(1ms);
  while (heard.has_more()) heard.next();
  for (const int before = asked; asked < before + 3;) std::this_thread::sleep_for(1ms);
  EXPECT_FALSE(heard.has_more());
  is_alive = true;
  EXPECT_EQ(heard.next(), "WATCHDOG=1");
}

TEST(Server, AnswersItself) {
  test::RunningServer running({.max_connections = 1});
  running.client.status();  // no client finds a place any more
  EXPECT_TRUE(running.server.answers_itself(10s));
  EXPECT_TRUE(running.server.answers_itself(10s));
  EXPECT_EQ(running.client.status().connections, 1U);
  running.server.stop();
  EXPECT_FALSE(running.server.answers_itself(100ms));
}

}  // namespace
}  // namespace nbvopt
