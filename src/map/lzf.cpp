#include "map/lzf.hpp"

#include <cstdint>

namespace nbvopt {

std::optional<std::string> lzf_decompressed(std::string_view compressed, std::size_t size) {
  std::string bytes;
  std::size_t next = 0;
  const auto take = [&]() -> std::size_t {
    return next < compressed.size() ? static_cast<std::uint8_t>(compressed[next++]) : 0;
  };
  while (next < compressed.size()) {
    const std::size_t control = take();
    if (control < 32) {  // control + 1 bytes as they are
      if (compressed.size() - next < control + 1) return std::nullopt;
      bytes.append(compressed.substr(next, control + 1));
      next += control + 1;
    } else {  // a copy of what was written before: 3 bits of length, 13 of distance
      std::size_t length = control >> 5;
      if (length == 7) length += take();
      const std::size_t distance = ((control & 31) << 8 | take()) + 1;
      if (distance > bytes.size()) return std::nullopt;
      for (length += 2; length > 0; --length) bytes += bytes[bytes.size() - distance];
    }
    if (bytes.size() > size) return std::nullopt;
  }
  if (bytes.size() != size) return std::nullopt;
  return bytes;
}

}  // namespace nbvopt
