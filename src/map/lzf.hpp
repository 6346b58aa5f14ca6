// LZF, the compression of PCD files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nbvopt {

/// What `compressed` holds, which must be `size` bytes; none when it is not.
std::optional<std::string> lzf_decompressed(std::string_view compressed, std::size_t size);

}  // namespace nbvopt
