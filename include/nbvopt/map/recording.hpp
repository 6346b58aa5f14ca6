// Recordings of a depth camera: folders of depth images or clouds, with poses, as public data sets
// lay them out. A convention carries where things lie, scale, invalid value, axes and camera.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/depth_image.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

enum class RecordingFormat {
  tum,           ///< TUM RGB-D: depth/*.png at 5000 a metre, groundtruth.txt by time
  icl_nuim,      ///< ICL-NUIM: as TUM, fy negative, poses in groundtruth.txt or *.gt.freiburg
  seven_scenes,  ///< 7-Scenes: frame-*.depth.png in mm, a 4 x 4 matrix in each frame-*.pose.txt
  scannet,       ///< ScanNet: depth/*.png in mm, pose/*.txt, intrinsic/intrinsic_depth.txt
  redwood,       ///< Redwood, Open3D: depth/*.png in mm, a trajectory of matrices (.log)
  replica,       ///< Replica as NICE-SLAM renders it: results/depth*.png, a matrix a line
  kitti,         ///< KITTI odometry: velodyne/*.bin, poses.txt of the left camera, calib.txt
  named,         ///< clouds or depth images, poses.txt: name or time x y z qx qy qz qw
  viewpoint,     ///< PCD files, each with its VIEWPOINT
  map_frame,     ///< clouds in the map frame: poses.txt as for named, or VIEWPOINT; the orientation
                 ///< may be left out, the sensor then looks at the middle of its points
};
std::string to_string(RecordingFormat value);

/// The axes of the frame whose pose is told.
enum class PoseAxes {
  optical,  ///< z forward, x right, y down
  body,     ///< x forward, y left, z up
  opengl,   ///< z backward, x right, y up
};
std::string to_string(PoseAxes value);

/// Which axis of the poses' world points up; the map's z does.
enum class UpAxis { plus_z, minus_z, plus_y, minus_y, plus_x, minus_x };
std::string to_string(UpAxis value);

/// What overrides the convention.
struct RecordingOptions {
  RecordingFormat format = RecordingFormat::tum;
  std::filesystem::path pose_file{};                      ///< empty: the convention's
  std::optional<std::array<double, 4>> fx_fy_cx_cy_px{};  ///< of depth images
  std::optional<double> depth_scale_m{};                  ///< as in DepthImageOptions
  std::optional<LargestValue> largest_value{};
  std::optional<PoseAxes> axes{};
  UpAxis up = UpAxis::plus_z;
  double max_time_difference_s = 0.02;  ///< between a frame and its pose
};

struct RecordedFrame {
  std::filesystem::path file;
  Transform T_world_frame = Transform::Identity();  ///< world and frame as the recording has them
  bool has_orientation = true;                      ///< if not, it looks at its points' middle
};

struct Recording {
  std::vector<RecordedFrame> frames;  ///< in the recording's order
  std::uint64_t frames_without_pose = 0;
  std::optional<DepthImageOptions> depth_image;
  PoseAxes axes = PoseAxes::optical;
  UpAxis up = UpAxis::plus_z;
  bool is_in_world_frame = false;  ///< the points of clouds, instead of in the frame
};

/// A frame as insert_scan() takes it.
struct PosedScan {
  Scan scan;
  Transform T_map_sensor = Transform::Identity();
};

/// Lists the frames of a recording that have a pose. Throws InputError that names what is missing:
/// folder, frames, poses; and a pose file's line that cannot be read.
Recording find_recording(const std::filesystem::path& folder, const RecordingOptions& options);

/// Reads a frame. Throws InputError as read_scan() does.
PosedScan read_frame(const Recording& recording, const RecordedFrame& frame);

}  // namespace nbvopt
