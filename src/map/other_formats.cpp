#include "map/other_formats.hpp"

#include <array>
#include <string_view>

namespace nbvopt {
namespace {

struct OtherFormat {
  std::string_view first_bytes;
  const char* name_and_remedy;
};

constexpr const char* kArchive =
    "it is an archive or packed, by another program than gzip: unpack it first";
constexpr const char* kPoints = "it is a point cloud: insert it into a map as a scan";
constexpr const char* kPlan = "it is a floor plan, which tells no heights";
constexpr const char* kVoxels =
    "it is of another map library: write its map as a .bt, or its occupied voxels as points, with "
    "that library";
constexpr const char* kRecording =
    "it is a ROS recording: save the bytes of `data` of one octomap_msgs/Octomap";
constexpr const char* kMessage =
    "if it is a message as text, save the bytes of its `data` alone, and say its id, resolution "
    "and kind";

constexpr auto kOtherFormats = std::to_array<OtherFormat>({
    {"PK\x03\x04", kArchive},
    {"BZh", kArchive},
    {"\xFD"
     "7zXZ",
     kArchive},
    {"\x28\xB5\x2F\xFD", kArchive},
    {"ply\n", kPoints},
    {"ply\r", kPoints},
    {"# .PCD", kPoints},
    {"P2\n", kPlan},
    {"P5\n", kPlan},
    {"image:", kPlan},
    {"# UFOMap", kVoxels},
    {"Bonxai::", kVoxels},
    {" BDV", kVoxels},  // OpenVDB
    {"#ROSBAG", kRecording},
    {"SQLite format 3", kRecording},
    {"\x89MCAP", kRecording},
    {"{", kMessage},
    {"header:", kMessage},
});

}  // namespace

std::string what_else(ByteReader& in) {
  for (const auto& [first_bytes, name_and_remedy] : kOtherFormats) {
    if (in.begins_with(first_bytes)) return name_and_remedy;
  }
  return "if it is another program's map, write it as a .bt with that program";
}

}  // namespace nbvopt
