#include "server/web/web_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "server/web/live_world.hpp"
#include "server/web/raw_http.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class WebServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      server.emplace("127.0.0.1:0", limits, sources);
    } catch (const UsageError& error) {
      if (std::string(error.what()).find("no web server") == std::string::npos) throw;
      GTEST_SKIP() << error.what();
    }
  }

  std::string get(const std::string& path, const std::string& headers = "Host: localhost\r\n") {
    return test::get(server->address(), path, headers);
  }

  const ServerLimits limits{.max_send_s = 0.2, .max_web_connections = 4};
  test::LiveWorld world;
  const WebSources sources{.status =
                               [] {
                                 v1::GetStatusReply status;
                                 status.set_map_version(42);
                                 return status;
                               },
                           .live = world.sources()};
  std::optional<WebServer> server;
};

TEST_F(WebServerTest, ShowsFigures) {
  const std::string answer = get("/metrics");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(answer, HasSubstr("Content-Type: text/plain; version=0.0.4"));
  EXPECT_THAT(answer, HasSubstr("nbvopt_map_version 42\n"));
  EXPECT_THAT(get("/metrics"), HasSubstr("nbvopt_web_answers_total 2\n"));
  EXPECT_THAT(get("/other"), StartsWith("HTTP/1.1 404 "));
}

TEST_F(WebServerTest, ShowsThePageAndItsMap) {
  const std::string page = get("/");
  EXPECT_THAT(page, HasSubstr("Content-Type: text/html"));
  EXPECT_THAT(page,
              HasSubstr("\r\nContent-Security-Policy: default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(page, HasSubstr("frame-ancestors 'none'\r\n"));
  EXPECT_THAT(page, EndsWith("</html>\n"));
  const std::string map = get("/map");
  EXPECT_THAT(map,
              HasSubstr("\r\n\r\n{\"id\":\"7-1\",\"is_whole\":true,\"map\":{\"name\":\"small\""));
  EXPECT_THAT(map, EndsWith("\"}}"));
  EXPECT_THAT(get("/map?since=7-1"), EndsWith("\"bricks\":{}}"));
  EXPECT_THAT(get("/gains"), EndsWith("\r\n\r\n{\"plan\":0}"));
}

TEST_F(WebServerTest, TellsReadersOfChanges) {
  const Descriptor reader = test::connect_to(server->address());
  test::send_all(reader, "GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(test::receive_until(reader, "\n\n"), HasSubstr("\ndata: {\"map\":\"7-1\","));
  world.scan();
  EXPECT_THAT(test::receive_until(reader, "\n\n"), HasSubstr("\ndata: {\"map\":\"7-2\","));
  server->stop();
  test::receive_all(reader);
}

TEST_F(WebServerTest, KeepsPlacesFreeOfReaders) {
  std::vector<Descriptor> readers;
  for (int i = 0; i < 2; ++i) {
    readers.push_back(test::connect_to(server->address()));
    test::send_all(readers.back(), "GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_THAT(test::receive_until(readers.back(), "\n\n"), HasSubstr("7-1"));
  }
  EXPECT_THAT(get("/events"), StartsWith("HTTP/1.1 503 "));
  EXPECT_THAT(get("/metrics"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(WebServerTest, LetsGoWhoDoesNotTakeItsAnswer) {
  const std::size_t whole = get("/").size();
  const Descriptor slow = test::connect_to(server->address(), 4096);
  test::send_all(slow, "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  char first = 0;
  ASSERT_EQ(::recv(slow.get(), &first, 1, MSG_PEEK), 1);  // the answer has begun
  test::wait_until([&] {                                  // until there is nobody but who asks
    return testing::Value(get("/metrics"), HasSubstr("nbvopt_web_connections 1\n"));
  });
  EXPECT_LT(test::receive_all(slow).size(), whole);
}

TEST_F(WebServerTest, KeepsOtherPagesOut) {
  EXPECT_THAT(get("/metrics", ""), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(get("/metrics", "Host: evil.example\r\n"), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(get("/metrics", "Host: localhost\r\nOrigin: http://evil.example\r\n"),
              StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(get("/metrics"), HasSubstr("nbvopt_web_forbidden_total 3\n"));
}

TEST_F(WebServerTest, BearsRequestsThatAreNone) {
  const auto answer = [&](const std::string& request) {
    return test::answer_to(server->address(), request);
  };
  EXPECT_EQ(answer(std::string(100'000, 'G')), "");
  EXPECT_THAT(answer("\r\n\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(answer(std::string("\0\xff\r\n\r\n", 6)), StartsWith("HTTP/1.1 400 "));
  std::string headers;
  for (int i = 0; i < 10'000; ++i) headers += "A: b\r\n";
  EXPECT_THAT(get("/metrics", headers), StartsWith("HTTP/1.1 400 "));
  // The library would make a picture of as many pieces, each as long as the whole.
  std::string ranges = "0-";
  for (int i = 0; i < 2'000; ++i) ranges += ",0-";
  EXPECT_LT(get("/metrics", "Host: localhost\r\nRange: bytes=" + ranges + "\r\n").size(),
            1'000'000U);
  // A body that is promised and does not come is not waited for.
  EXPECT_THAT(answer("POST /metrics HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000000000"
                     "\r\n\r\n"),
              StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(get("/metrics"), StartsWith("HTTP/1.1 200 "));
}

TEST_F(WebServerTest, ServesOthersWhileSomeSayHalfAWord) {
  std::vector<Descriptor> slow;
  for (int i = 0; i < 3; ++i) {
    slow.push_back(test::connect_to(server->address()));
    test::send_all(slow.back(), "GET /metrics HTTP/1.1\r\n");
  }
  const std::string answer = get("/metrics");
  EXPECT_THAT(answer, HasSubstr("nbvopt_web_connections 4\n"));
  server->stop();  // and waits for none of them
  for (const Descriptor& each : slow) test::receive_all(each);
}

TEST_F(WebServerTest, TurnsAwayWhoIsTooMany) {
  std::vector<Descriptor> slow;
  for (int i = 0; i < 4; ++i) {
    slow.push_back(test::connect_to(server->address()));
    test::send_all(slow.back(), "G");
  }
  std::string answer;
  do {  // until all of them have their places
    answer = get("/metrics");
  } while (!answer.empty());
  slow.clear();
  do {
    answer = get("/metrics");
  } while (answer.empty());
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(answer, Not(HasSubstr("nbvopt_web_connections_refused_total 0\n")));
}

TEST_F(WebServerTest, ListensOnItsOwnMachineAlone) {
  const auto refusal = [&](const std::string& listen) {
    return test::message_of<UsageError>([&] { WebServer(listen, limits, sources); });
  };
  EXPECT_THAT(refusal("0.0.0.0:0"), HasSubstr("web: '0.0.0.0:0' can be reached"));
  EXPECT_THAT(refusal("here"), HasSubstr("web: 'here' is no address"));
  const test::TemporaryFolder folder;
  const WebServer on_socket("unix:" + (folder / "web"), limits, sources);
  EXPECT_EQ(on_socket.address(), "unix:" + (folder / "web"));
}

}  // namespace
}  // namespace nbvopt
