// Enumerators and their names, there and back.
#include "core/enum_names.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

enum class Colour { red, green, blue };
enum class Signal { stop = 7, go = 9 };

}  // namespace

template <>
inline constexpr auto kEnumNames<Colour> = std::to_array<EnumName<Colour>>({
    {Colour::red, "red"},
    {Colour::green, "dark-green"},
});

namespace {

TEST(EnumNames, LeadThereAndBack) {
  EXPECT_EQ(enum_name(Colour::green), "dark-green");
  EXPECT_EQ(enum_value<Colour>("dark-green"), Colour::green);
  EXPECT_EQ(enum_value<Colour>("green"), std::nullopt);
  EXPECT_EQ(enum_value<Colour>(""), std::nullopt);
}

TEST(EnumNames, HaveAWordForWhatHasNone) { EXPECT_EQ(enum_name(Colour::blue), "?"); }

TEST(EnumNames, AreListedInOrder) {
  EXPECT_EQ(enum_names<Colour>(), (std::vector<std::string>{"red", "dark-green"}));
}

TEST(EnumNames, StandForEnumeratorsOfAProtocol) {
  constexpr auto kSignals = std::to_array<EnumName<Colour, Signal>>(
      {{Colour::red, Signal::stop}, {Colour::green, Signal::go}});
  EXPECT_EQ(name_in(kSignals, Colour::green), Signal::go);
  EXPECT_EQ(value_in(kSignals, Signal::stop), Colour::red);
  EXPECT_EQ(name_in(kSignals, Colour::blue), std::nullopt);
}

}  // namespace
}  // namespace nbvopt
