// Folders that are made when they are needed.
#pragma once

#include <filesystem>

namespace nbvopt {

/// Makes the folder and those above it; one that is there is left alone. Throws InputError that
/// names it when that fails.
void create_folder(const std::filesystem::path& folder);

}  // namespace nbvopt
