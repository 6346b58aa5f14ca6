// World files, read with libsdformat.
#pragma once

#include <filesystem>
#include <sdf/Root.hh>

#include "sim/world/model_paths.hpp"
#include "sim/world/world_log.hpp"

namespace nbvopt {

/// Reads a world or a model with all that it includes, as far as libsdformat understands it; its
/// complaints go to the log. Throws InputError that names the file and the first fault when it is
/// not readable as SDF, or models include each other without end.
sdf::Root read_sdf_document(const std::filesystem::path& path, ModelPaths& model_paths,
                            WorldLog& log);

}  // namespace nbvopt
