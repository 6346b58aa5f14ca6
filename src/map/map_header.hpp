// The first lines of OctoMap's files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "map/byte_reader.hpp"

namespace nbvopt {

/// By which files are told apart.
inline constexpr const char* kBinaryMagic = "# Octomap OcTree binary file";  ///< .bt
inline constexpr const char* kFullMagic = "# Octomap OcTree file";           ///< .ot

struct MapHeader {
  bool is_binary = false;  ///< .bt
  std::string tree_type;
  std::optional<std::uint64_t> nodes;  ///< none where the header does not say
  double resolution_m = 0.0;
};

/// Reads up to the first node. `name` stands for the file in messages; `warnings` get a line for
/// what is missing and can be done without. Throws InputError.
MapHeader read_map_header(ByteReader& in, const std::string& name,
                          std::vector<std::string>& warnings);

/// The header as OctoMap writes it, but with the resolution's every digit.
std::string map_file_header(const char* magic, const char* tree_type, std::uint64_t nodes,
                            double resolution_m);

}  // namespace nbvopt
