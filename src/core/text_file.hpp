// Whole text files.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace nbvopt {

/// The content of a text file. Throws InputError that names the file when it cannot be read or
/// is empty.
std::string read_text_file(const std::filesystem::path& path);

/// The rest of a stream; `name` stands for the file in messages.
std::string read_text(std::istream& in, const std::string& name);

}  // namespace nbvopt
