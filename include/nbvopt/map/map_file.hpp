// Reading and writing map files.
//
// Read:  .bt (any occupancy tree), .ot of type OcTree, ColorOcTree and UncertaintyOcTree. The
//        content decides, not the file's name.
// Write: .ot of type UncertaintyOcTree (per node: float log-odds, 3 bytes colour, float u, 1 byte
//        child mask), .bt, and for viewing .ot of type ColorOcTree and .ply, both coloured by u.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

enum class MapFormat {
  uncertainty_ot,  ///< .ot, everything that the map holds
  bt,              ///< .bt, maximum likelihood occupancy
  colour_ot,       ///< .ot of type ColorOcTree, the colour telling u (octovis opens it)
  colour_ply,      ///< .ply, one coloured point an occupied voxel
};
std::string to_string(MapFormat format);

/// The format of that name: uncertainty-ot, bt, colour-ot or ply. Where it is empty, that of the
/// file's extension, .ot being uncertainty-ot. Throws UsageError when there is none.
MapFormat map_format(const std::string& name, const std::filesystem::path& path);

/// Reads a map. Throws InputError when the file is missing, empty, truncated, damaged, or of a
/// tree type that is not known; the message names the file.
UncertaintyMap read_map(const std::filesystem::path& path);

/// The same from a stream; `name` stands for the file in messages.
UncertaintyMap read_map(std::istream& in, const std::string& name);

/// The bytes of such a file.
std::string map_file_bytes(const UncertaintyMap& map, MapFormat format);

/// Writes a map atomically: a temporary file beside `path`, then a rename. Throws InputError when
/// the folder is missing or not writable, or the disk is full; `path` is then untouched.
void write_map(const UncertaintyMap& map, const std::filesystem::path& path, MapFormat format);

}  // namespace nbvopt
