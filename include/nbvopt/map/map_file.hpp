// Reading and writing map files.
//
// Read:  .bt (any occupancy tree), .ot of type OcTree, OcTreeStamped, ColorOcTree and
//        UncertaintyOcTree, and the occupancy of other types that derive from OctoMap's; each also
//        packed by gzip. The content decides, not the file's name. Nodes alone, as ROS messages
//        hold them.
// Write: .ot of type UncertaintyOcTree (per node: float log-odds, 3 bytes colour, float u, 1 byte
//        child mask), .bt, and for viewing .ot of type ColorOcTree, .ply and .pcd, all coloured by
//        u. Floor plans: floor_plan.hpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

enum class MapFormat {
  uncertainty_ot,  ///< .ot, everything that the map holds
  bt,              ///< .bt, maximum likelihood occupancy
  colour_ot,       ///< .ot of type ColorOcTree, the colour telling u (octovis opens it)
  colour_ply,      ///< .ply, one coloured point a voxel of the surfaces
  colour_pcd,      ///< .pcd, the same
};
std::string to_string(MapFormat format);

/// Which occupied voxels are written as points.
enum class MapPoints {
  surface,  ///< those with a face to a voxel that is not occupied
  all,
};

/// More points are not written: 300 MB.
inline constexpr std::uint64_t kMostMapPoints = 20'000'000;

/// The format of that name: uncertainty-ot, bt, colour-ot, ply or pcd. Where it is empty, that of
/// the file's extension, .ot being uncertainty-ot. Throws UsageError when there is none.
MapFormat map_format(const std::string& name, const std::filesystem::path& path);

/// Reads a map. Infinite log-odds become OctoMap's limits; a header that does not say how many
/// nodes there are is taken as it is. Throws InputError when the file is missing, empty, truncated,
/// damaged, unpacks to more than 50 times its size, or is of a tree type that holds no occupancy;
/// the message names the file.
UncertaintyMap read_map(const std::filesystem::path& path);

/// The same; `warnings` get a line for whatever could not be taken as it stands.
UncertaintyMap read_map(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// The same from a stream; `name` stands for the file in messages.
UncertaintyMap read_map(std::istream& in, const std::string& name);
UncertaintyMap read_map(std::istream& in, const std::string& name,
                        std::vector<std::string>& warnings);

/// The fields of a ROS message octomap_msgs/Octomap that say what its data are.
struct MapMessage {
  std::string tree_type;      ///< `id`
  double resolution_m = 0.0;  ///< `resolution`
  bool is_binary = false;     ///< `binary`: as in a .bt; otherwise as in an .ot
};

/// Reads the bytes of a message's `data`: nodes without a header. Throws InputError as read_map()
/// does, for a resolution that cannot be, and where bytes are left after the tree.
UncertaintyMap read_map_message(const std::filesystem::path& path, const MapMessage& message,
                                std::vector<std::string>& warnings);
UncertaintyMap read_map_message(std::istream& in, const std::string& name,
                                const MapMessage& message, std::vector<std::string>& warnings);

/// The bytes of such a file. `points` is heeded by .ply and .pcd, which throw InputError beyond
/// kMostMapPoints.
std::string map_file_bytes(const UncertaintyMap& map, MapFormat format,
                           MapPoints points = MapPoints::surface);

/// Writes a map atomically: a temporary file beside `path`, then a rename. Throws InputError as
/// map_file_bytes() does and when the folder is missing or not writable, or the disk is full;
/// `path` is then untouched.
void write_map(const UncertaintyMap& map, const std::filesystem::path& path, MapFormat format,
               MapPoints points = MapPoints::surface);

}  // namespace nbvopt
