// What stands where a map was expected.
#pragma once

#include <string>

#include "map/byte_reader.hpp"

namespace nbvopt {

/// Says of the bytes that follow, which are no map's, what they are and how to make a map of them,
/// in words for a message; nothing is taken.
std::string what_else(ByteReader& in);

}  // namespace nbvopt
