// Whatever text stands for a world, read_sdf_world() gives parts or an InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "nbvopt/core/error.hpp"
#include "sim/world/sdf_world.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto geometry : {nbvopt::WorldGeometry::visual, nbvopt::WorldGeometry::collision}) {
    nbvopt::WorldLog log;
    try {
      nbvopt::read_sdf_world(text, "/no/such/folder/fuzz.world", {.geometry = geometry}, log);
    } catch (const nbvopt::InputError&) {
    }
  }
  return 0;
}
