// The shapes of an SDF world.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "nbvopt/sim/world.hpp"
#include "sim/world/world_log.hpp"
#include "sim/world/world_part.hpp"

namespace nbvopt {

struct SdfWorld {
  std::vector<WorldPart> parts;
  std::uint64_t models = 0;         ///< direct children of the world, includes among them
  std::uint64_t nested_models = 0;  ///< models within models, at any depth
};

/// Reads the first world of a file, or its model, and the meshes that it names. Parts that cannot
/// be had are left out and logged. A saved <state> is not applied: models stand where they are
/// declared. Throws as read_sdf_document() does.
SdfWorld read_sdf_world(const std::filesystem::path& path, const WorldOptions& options,
                        WorldLog& log);

}  // namespace nbvopt
