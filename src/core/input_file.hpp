// Opening files that a user named.
#pragma once

#include <filesystem>
#include <fstream>

namespace nbvopt {

/// Opens a regular file, a pipe or a device for reading. Throws InputError that names the path and
/// says why when it is missing, a folder, not readable or empty.
std::ifstream open_input_file(const std::filesystem::path& path);

}  // namespace nbvopt
