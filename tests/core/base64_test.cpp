#include "core/base64.hpp"

#include <gtest/gtest.h>

namespace nbvopt::test {
namespace {

TEST(Base64, IsThatOfRfc4648) {
  // Section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAllBytes) {
  EXPECT_EQ(base64(std::string_view("\0\xFF\xFE\x80", 4)), "AP/+gA==");
}

}  // namespace
}  // namespace nbvopt::test
