// Numbers as files hold them.
#pragma once

#include <string>
#include <type_traits>

namespace nbvopt {

/// Appends a number in the machine's byte order, which is little-endian wherever this builds.
template <class Number>
requires std::is_trivially_copyable_v<Number>
void append(std::string& bytes, const Number& number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(Number));
}

}  // namespace nbvopt
