#include "server/web/entry_rules.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

int status(const WebCaller& caller, WebReach reach = WebReach::loopback) {
  const auto refusal = web_refusal(caller, reach);
  return refusal ? refusal->status : 200;
}

TEST(WebRefusal, LetsThisMachinesOwnNamesIn) {
  for (const char* host :
       {"localhost", "localhost:8080", "127.0.0.1:1", "127.1.2.3", "[::1]:8080", "[::1]"}) {
    EXPECT_EQ(status({.method = "GET", .host = host}), 200) << host;
    EXPECT_EQ(status({.method = "HEAD", .host = host}), 200) << host;
  }
}

TEST(WebRefusal, KeepsNamesOutThatMayBeAnybodys) {
  for (const char* host :
       {"", "evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example",
        "192.168.1.7", "[::2]:1", "[::1", "::1", ":1", "[evil"}) {
    EXPECT_EQ(status({.method = "GET", .host = host}), 403) << host;
    EXPECT_EQ(status({.method = "GET", .host = host}, WebReach::unix_socket), 200) << host;
  }
}

TEST(WebRefusal, KeepsOtherMethodsOut) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "CONNECT", "TRACE", "PATCH"}) {
    EXPECT_EQ(status({.method = method, .host = "localhost"}), 405) << method;
  }
}

TEST(WebRefusal, KeepsOtherPagesOut) {
  const WebCaller own{.method = "GET", .host = "localhost:80"};
  for (const char* origin : {"http://evil.example", "https://localhost:80", "http://localhost",
                             "http://localhost:81", "null"}) {
    WebCaller caller = own;
    caller.origin = origin;
    EXPECT_EQ(status(caller), 403) << origin;
    EXPECT_EQ(status(caller, WebReach::unix_socket), 403) << origin;
  }
  WebCaller caller = own;
  caller.origin = "http://localhost:80";
  EXPECT_EQ(status(caller), 200);
}

TEST(WebRefusal, HeedsWhatBrowsersSayOfThePageThatAsks) {
  const auto fetched = [](const char* site, const char* mode, const char* dest) {
    return status({.method = "GET",
                   .host = "localhost",
                   .fetch_site = site,
                   .fetch_mode = mode,
                   .fetch_dest = dest});
  };
  EXPECT_EQ(fetched("same-origin", "cors", "empty"), 200);
  EXPECT_EQ(fetched("none", "navigate", "document"), 200);
  EXPECT_EQ(fetched("cross-site", "navigate", "document"), 200);  // a link to the page
  EXPECT_EQ(fetched("cross-site", "navigate", "iframe"), 403);
  EXPECT_EQ(fetched("cross-site", "no-cors", "script"), 403);
  EXPECT_EQ(fetched("same-site", "cors", "empty"), 403);  // another port of this machine
}

}  // namespace
}  // namespace nbvopt
