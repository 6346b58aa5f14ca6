// Fingerprints: what is equal has the same one on every machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace nbvopt::experiment {

/// 32 hexadecimal digits (XXH3, 128 bits): no protection against forgery.
std::string digest(std::string_view bytes);

/// That of a file's content. Throws InputError that names the file when it cannot be read.
std::string file_digest(const std::filesystem::path& path);

}  // namespace nbvopt::experiment
