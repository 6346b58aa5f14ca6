// The ways in which chunks of a bag are packed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nbvopt {

/// Unpacks exactly `size` bytes from bzip2's or LZ4's frames. Memory grows with what comes out, not
/// with what is claimed. Throws InputError where the bytes are damaged or of another size.
std::string unpack_bz2(std::string_view packed, std::uint64_t size);
std::string unpack_lz4(std::string_view packed, std::uint64_t size);

}  // namespace nbvopt
