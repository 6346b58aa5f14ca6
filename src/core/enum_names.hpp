// Enumerators by the names that files, messages, answers and protocols give them: one table an
// enum.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nbvopt {

/// An enumerator and what stands for it elsewhere: a word, or an enumerator of a protocol.
template <class Enum, class Name = std::string_view>
struct EnumName {
  Enum value;
  Name name;
};

/// The name in such a table; none for a value that it does not hold.
template <class Table, class Enum>
constexpr auto name_in(const Table& table, Enum value) -> std::optional<decltype(table[0].name)> {
  for (const auto& entry : table) {
    if (entry.value == value) return entry.name;
  }
  return std::nullopt;
}

/// The way back.
template <class Table, class Name>
constexpr auto value_in(const Table& table, Name name) -> std::optional<decltype(table[0].value)> {
  for (const auto& entry : table) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

/// The words of an enum, in the order in which messages list them. Specialised for every enum that
/// has any.
template <class Enum>
inline constexpr std::array<EnumName<Enum>, 0> kEnumNames{};

/// The enumerator's word; "?" for a value that is no enumerator.
template <class Enum>
constexpr std::string_view enum_name(Enum value) {
  static_assert(!kEnumNames<Enum>.empty(), "include the header that names this enum");
  return name_in(kEnumNames<Enum>, value).value_or("?");
}

/// The enumerator of a word; none when it is not known.
template <class Enum>
constexpr std::optional<Enum> enum_value(std::string_view name) {
  static_assert(!kEnumNames<Enum>.empty(), "include the header that names this enum");
  return value_in(kEnumNames<Enum>, name);
}

/// All words.
template <class Enum>
std::vector<std::string> enum_names() {
  std::vector<std::string> names;
  for (const auto& entry : kEnumNames<Enum>) names.emplace_back(entry.name);
  return names;
}

}  // namespace nbvopt
