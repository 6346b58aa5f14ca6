#include "map/recording/conventions.hpp"

#include <algorithm>

#include "map/recording/recording_names.hpp"

namespace nbvopt {

namespace {

constexpr double kTumScale_m = 1.0 / 5000.0;
constexpr double kReplicaScale_m = 1.0 / 6553.5;
constexpr double kMillimetre_m = 0.001;
constexpr std::array kKinect{525.0, 525.0, 319.5, 239.5};
constexpr std::array kNoCamera{0.0, 0.0, 0.0, 0.0};

/// As the data sets' own pages and tools have them.
constexpr auto kConventions = std::to_array<Convention>({
    {RecordingFormat::tum,
     PoseSource::by_time,
     "depth",
     ".png",
     {"groundtruth.txt"},
     kTumScale_m,
     LargestValue::far,
     kKinect,
     PoseAxes::optical},
    {RecordingFormat::icl_nuim,
     PoseSource::by_time,
     "depth",
     ".png",
     {"groundtruth.txt", "*.gt.freiburg"},
     kTumScale_m,
     LargestValue::far,
     {481.2, -480.0, 319.5, 239.5},
     PoseAxes::optical},
    {RecordingFormat::seven_scenes,
     PoseSource::file_a_frame,
     "",
     ".depth.png",
     {"", ".pose.txt"},
     kMillimetre_m,
     LargestValue::invalid,
     {585.0, 585.0, 320.0, 240.0},
     PoseAxes::optical},
    {RecordingFormat::scannet,
     PoseSource::file_a_frame,
     "depth",
     ".png",
     {"pose", ".txt"},
     kMillimetre_m,
     LargestValue::far,
     kNoCamera,
     PoseAxes::optical},
    {RecordingFormat::redwood,
     PoseSource::trajectory_log,
     "depth",
     ".png",
     {"trajectory.log", "*.log"},
     kMillimetre_m,
     LargestValue::far,
     kKinect,
     PoseAxes::optical},
    {RecordingFormat::replica,
     PoseSource::matrix_a_line,
     "results",
     ".png",
     {"traj.txt"},
     kReplicaScale_m,
     LargestValue::far,
     {600.0, 600.0, 599.5, 339.5},
     PoseAxes::optical},
    {RecordingFormat::kitti,
     PoseSource::kitti,
     "velodyne",
     ".bin",
     {"poses.txt"},
     kMillimetre_m,
     LargestValue::no_return,
     kNoCamera,
     PoseAxes::body},
    {RecordingFormat::named,
     PoseSource::by_name,
     "",
     "",
     {"poses.txt"},
     kMillimetre_m,
     LargestValue::no_return,
     kNoCamera,
     PoseAxes::optical},
    {RecordingFormat::viewpoint,
     PoseSource::viewpoint,
     "",
     ".pcd",
     {},
     kMillimetre_m,
     LargestValue::no_return,
     kNoCamera,
     PoseAxes::optical},
    {RecordingFormat::map_frame,
     PoseSource::by_name,
     "",
     "",
     {"poses.txt"},
     kMillimetre_m,
     LargestValue::no_return,
     kNoCamera,
     PoseAxes::optical},
});

}  // namespace

std::span<const Convention> conventions() { return kConventions; }

const Convention& convention_of(RecordingFormat format) {
  return *std::ranges::find(kConventions, format, &Convention::format);
}

std::string to_string(RecordingFormat value) { return std::string(enum_name(value)); }
std::string to_string(PoseAxes value) { return std::string(enum_name(value)); }
std::string to_string(UpAxis value) { return std::string(enum_name(value)); }

}  // namespace nbvopt
