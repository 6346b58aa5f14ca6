#include "experiment/digest.hpp"

#include <xxhash.h>

#include <array>
#include <cstdio>

#include "core/text_file.hpp"

namespace nbvopt::experiment {

std::string digest(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%016llx%016llx",
                static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text.data();
}

std::string file_digest(const std::filesystem::path& path) { return digest(read_text_file(path)); }

}  // namespace nbvopt::experiment
