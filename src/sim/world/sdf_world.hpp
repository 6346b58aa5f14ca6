// The shapes of an SDF world.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "nbvopt/sim/people.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_log.hpp"
#include "sim/world/world_part.hpp"

namespace nbvopt {

struct SdfWorld {
  std::vector<WorldPart> parts;
  People people;
  std::uint64_t models = 0;         ///< direct children of the world, includes among them
  std::uint64_t nested_models = 0;  ///< models within models, at any depth
};

/// Reads the first world of a text, or its model, and the files that it names. A part that cannot
/// be had, or has a bad value, is left out and logged; a saved <state> is applied. Throws
/// InputError that names the file when it is no XML, or holds neither a world nor a model; or when
/// it would grow too large.
SdfWorld read_sdf_world(const std::string& text, const std::filesystem::path& path,
                        const WorldOptions& options, WorldLog& log);

}  // namespace nbvopt
