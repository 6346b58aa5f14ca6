#include "core/number.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nbvopt {
namespace {

TEST(ParseNumber, ReadsWhatPeopleType) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("-0.2"), -0.2);
  EXPECT_EQ(parse_number("+3"), 3.0);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  EXPECT_EQ(parse_number("2."), 2.0);
  EXPECT_EQ(parse_number("1e-3"), 0.001);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_TRUE(std::isinf(parse_number("-inf").value()));
}

TEST(ParseNumber, RefusesAllThatIsNotOneNumber) {
  for (const char* text :
       {"", " 1", "1 ", "1,2", "1.5rad", "0x10", "--1", "+-1", "+", "-", ".", "1e999", "one"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << "'" << text << "'";
  }
}

TEST(FormatNumber, IsShortAndReadsBackTheSame) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(-3.0), "-3");
  for (const double value : {1.0 / 3.0, 0.51487212933832716, 1e-300, 123456789.125}) {
    EXPECT_EQ(parse_number(format_number(value)), value);
  }
}

}  // namespace
}  // namespace nbvopt
