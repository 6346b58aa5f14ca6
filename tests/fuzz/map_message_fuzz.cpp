// Whatever bytes stand for a message's data, read_map_message() gives a map or an InputError. The
// first byte says what the message's other fields hold.
#include <array>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr std::array kTypes{"OcTree", "ColorOcTree", "UncertaintyOcTree", "OtherTree"};
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  std::vector<std::string> warnings;
  try {
    nbvopt::read_map_message(in, "fuzz",
                             {.tree_type = kTypes.at(data[0] >> 1 & 3),
                              .resolution_m = data[0] >> 3 & 1 ? 0.0 : 0.1,
                              .is_binary = (data[0] & 1) != 0},
                             warnings)
        .counts();
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
