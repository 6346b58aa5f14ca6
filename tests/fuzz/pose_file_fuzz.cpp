// Whatever text stands for a pose file, parse_pose_file() gives poses or an InputError.
#include <cstddef>
#include <cstdint>
#include <string>

#include "nbvopt/core/error.hpp"
#include "planner/pose_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    nbvopt::parse_pose_file(text, "fuzz", {});
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
