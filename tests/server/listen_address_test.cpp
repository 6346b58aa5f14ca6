#include "server/listen_address.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text, const TlsFiles& tls = {}) {
  return test::message_of<UsageError>([&] { check_tls(parse_listen_address(text), tls); });
}

TEST(ListenAddress, OfThisMachineNeedsNoCertificates) {
  for (const char* text : {"127.0.0.1:50051", "127.1.2.3:0", "localhost:1", "[::1]:50051",
                           "unix:/run/nbvopt", "unix:relative"}) {
    EXPECT_EQ(refusal(text), "") << text;
    EXPECT_THAT(refusal(text, {.certificate = "c", .key = "k", .client_ca = "a"}),
                HasSubstr("needs no certificates"));
  }
}

TEST(ListenAddress, OfOtherMachinesNeedsAllThree) {
  for (const char* text : {"0.0.0.0:50051", "192.168.1.7:1", "[::]:50051", "robot:50051",
                           "127.0.0.1.example.org:1", "[::ffff:127.0.0.1]:1"}) {
    EXPECT_THAT(refusal(text), HasSubstr("client CA")) << text;
    EXPECT_THAT(refusal(text, {.certificate = "c", .key = "k", .client_ca = ""}),
                HasSubstr("client CA"));
    EXPECT_EQ(refusal(text, {.certificate = "c", .key = "k", .client_ca = "a"}), "") << text;
  }
}

TEST(ListenAddress, IsRefusedWhenItIsNone) {
  for (const char* text : {"", "here", "host:", "host:port", "host:65536", "host:-1", ":1"}) {
    EXPECT_THAT(refusal(text), HasSubstr("write HOST:PORT or unix:PATH")) << text;
  }
  EXPECT_THAT(refusal("unix:"), HasSubstr("names no socket"));
  EXPECT_THAT(refusal("unix:" + std::string(108, 'a')), HasSubstr("too long"));
}

}  // namespace
}  // namespace nbvopt
