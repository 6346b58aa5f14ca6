// Whatever bytes stand for a map, read_map() gives a map or an InputError.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  try {
    nbvopt::read_map(in, "fuzz").counts();
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
