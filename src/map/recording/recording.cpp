#include "nbvopt/map/recording.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <unordered_map>
#include <utility>

#include "core/input_file.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "map/point_records.hpp"
#include "map/recording/conventions.hpp"
#include "map/recording/frame_files.hpp"
#include "map/recording/pose_lists.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

/// As TUM's page lists them: fx, fy, cx, cy of the colour images, to which depth is registered.
constexpr std::array<std::pair<const char*, std::array<double, 4>>, 3> kTumCameras{{
    {"freiburg1", {517.3, 516.5, 318.6, 255.3}},
    {"freiburg2", {520.9, 521.0, 325.1, 249.7}},
    {"freiburg3", {535.4, 539.2, 320.1, 247.6}},
}};

std::optional<double> time_of(const std::string& text) {
  const auto time_s = parse_scan_number(text);
  return time_s && std::isfinite(*time_s) ? time_s : std::nullopt;
}

/// Finds frames and their poses.
class FrameFinder {
 public:
  FrameFinder(const fs::path& folder, const RecordingOptions& options)
      : folder_(folder),
        options_(options),
        convention_(convention_of(options.format)),
        files_(frame_files(folder / convention_.frame_folder, convention_.frame_suffix)) {}

  void find(Recording& recording) && {
    switch (convention_.source) {
      case PoseSource::by_time:
        by_time();
        break;
      case PoseSource::by_name:
        by_name();
        break;
      case PoseSource::file_a_frame:
        file_a_frame();
        break;
      case PoseSource::matrix_a_line:
        in_order(parse_matrix_lines(pose_text(), name_));
        break;
      case PoseSource::trajectory_log:
        trajectory_log();
        break;
      case PoseSource::kitti:
        kitti();
        break;
      case PoseSource::viewpoint:
        viewpoints();
        break;
    }
    recording.frames = std::move(frames_);
    recording.frames_without_pose = without_pose_;
    if (recording.frames.empty()) {
      throw InputError(folder_.string() + ": none of its " + std::to_string(without_pose_) +
                       " frames has a pose" + (name_.empty() ? "" : " in " + name_) + why_none());
    }
  }

 private:
  /// The text of the pose file, whose name is noted.
  std::string pose_text() {
    fs::path file = options_.pose_file;
    if (file.empty()) {
      std::vector<std::string_view> names;
      for (const std::string_view name : convention_.pose_files) {
        if (!name.empty()) names.push_back(name);
      }
      file = find_file(folder_, names);
    }
    name_ = file.string();
    return read_text_file(file);
  }

  void add(const fs::path& file, const std::optional<Transform>& T_world_frame) {
    if (T_world_frame) {
      frames_.push_back({file, *T_world_frame});
    } else {
      ++without_pose_;
    }
  }

  void add(const fs::path& file, const KeyedPose* pose) {
    if (pose != nullptr) {
      frames_.push_back({file, pose->T_world_frame, pose->has_orientation});
    } else {
      ++without_pose_;
    }
  }

  void by_time() {
    const std::vector<KeyedPose> poses = parse_keyed_poses(pose_text(), name_);
    const TimedPoses timed(poses, name_);
    if (std::ranges::any_of(poses, std::logical_not{}, &KeyedPose::has_orientation)) {
      throw InputError(name_ + ": a pose has no orientation, lines are 'time x y z qx qy qz qw'");
    }
    for (const TimedFile& file : timed_files(folder_, files_)) {
      add(file.file,
          file.time_s ? timed.nearest(*file.time_s, options_.max_time_difference_s) : nullptr);
    }
  }

  /// By the file's name, with its extension or without; or, where all poses tell times, by the one
  /// that the name is.
  void by_name() {
    if (convention_.format == RecordingFormat::map_frame && options_.pose_file.empty() &&
        !fs::exists(folder_ / convention_.pose_files.front())) {
      return viewpoints();
    }
    const std::vector<KeyedPose> poses = parse_keyed_poses(pose_text(), name_);
    std::unordered_map<std::string, const KeyedPose*> named;
    for (const KeyedPose& pose : poses) {
      if (!pose.has_orientation && convention_.format != RecordingFormat::map_frame) {
        throw InputError(name_ + ": the pose of '" + pose.key + "' has no orientation");
      }
      named.emplace(pose.key, &pose);
    }
    std::optional<TimedPoses> timed;
    if (std::ranges::all_of(poses,
                            [](const KeyedPose& pose) { return time_of(pose.key).has_value(); })) {
      timed.emplace(poses, name_);
    }
    for (const fs::path& file : files_) {
      auto found = named.find(file.filename().string());
      if (found == named.end()) found = named.find(file.stem().string());
      const KeyedPose* pose = found != named.end() ? found->second : nullptr;
      if (const auto time_s = time_of(file.stem().string()); pose == nullptr && timed && time_s) {
        pose = timed->nearest(*time_s, options_.max_time_difference_s);
      }
      add(file, pose);
    }
  }

  void file_a_frame() {
    const auto [folder, suffix, unused] = convention_.pose_files;
    for (const fs::path& file : files_) {
      const fs::path pose =
          folder_ / folder / (without_suffix(file, convention_.frame_suffix) + std::string(suffix));
      const std::string name = pose.string();
      add(file, fs::exists(pose) ? parse_pose_matrix(read_text_file(pose), name) : std::nullopt);
    }
  }

  void in_order(const std::vector<std::optional<Transform>>& poses) {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      add(files_[i], i < poses.size() ? poses[i] : std::nullopt);
    }
  }

  void trajectory_log() {
    std::vector<std::optional<Transform>> poses(files_.size());
    for (const NumberedPose& pose : parse_trajectory_log(pose_text(), name_)) {
      if (pose.frame < poses.size()) poses[pose.frame] = pose.T_world_frame;
    }
    in_order(poses);
  }

  /// poses.txt tells where the left camera is; the clouds are the laser's.
  void kitti() {
    const fs::path calibration = folder_ / "calib.txt";
    const Transform T_camera_laser =
        parse_calibration(read_text_file(calibration), "Tr", calibration.string());
    std::vector<std::optional<Transform>> poses = parse_matrix_lines(pose_text(), name_);
    for (auto& T_world_camera : poses) {
      if (T_world_camera) T_world_camera = *T_world_camera * T_camera_laser;
    }
    in_order(poses);
  }

  void viewpoints() {
    for (const fs::path& file : files_) {
      std::ifstream in = open_input_file(file);
      add(file, file.extension() == ".pcd" ? read_pcd_viewpoint(in, file.string()) : std::nullopt);
    }
  }

  std::string why_none() const {
    return convention_.source == PoseSource::by_time
               ? ": is max_time_difference_s, " + format_number(options_.max_time_difference_s) +
                     ", enough, and are they of one recording?"
               : "";
  }

  const fs::path& folder_;
  const RecordingOptions& options_;
  const Convention& convention_;
  std::vector<fs::path> files_;
  std::string name_;  ///< of the pose file, for messages
  std::vector<RecordedFrame> frames_;
  std::uint64_t without_pose_ = 0;
};

/// The camera of TUM's first robot and hand-held sequences differs from the Kinect's ideal one.
std::array<double, 4> camera_of(const Convention& convention, const fs::path& folder) {
  const std::string name = fs::weakly_canonical(folder).string();
  if (convention.format == RecordingFormat::tum) {
    for (const auto& [camera, fx_fy_cx_cy_px] : kTumCameras) {
      if (name.find(camera) != std::string::npos) return fx_fy_cx_cy_px;
    }
  }
  const fs::path scannet = folder / "intrinsic" / "intrinsic_depth.txt";
  if (convention.format == RecordingFormat::scannet && fs::exists(scannet)) {
    return parse_camera_matrix(read_text_file(scannet), scannet.string());
  }
  return convention.fx_fy_cx_cy_px;
}

std::optional<DepthImageOptions> depth_image_of(const Convention& convention,
                                                const fs::path& folder,
                                                const RecordingOptions& options) {
  const auto [fx, fy, cx, cy] =
      options.fx_fy_cx_cy_px ? *options.fx_fy_cx_cy_px : camera_of(convention, folder);
  if (fx == 0.0 && !options.fx_fy_cx_cy_px) return std::nullopt;
  DepthImageOptions image{
      .fx_px = fx,
      .fy_px = fy,
      .cx_px = cx,
      .cy_px = cy,
      .depth_scale_m = options.depth_scale_m.value_or(convention.depth_scale_m),
      .largest_value = options.largest_value.value_or(convention.largest_value)};
  image.validate();
  return image;
}

}  // namespace

Recording find_recording(const fs::path& folder, const RecordingOptions& options) {
  const Convention& convention = convention_of(options.format);
  Recording recording;
  recording.depth_image = depth_image_of(convention, folder, options);
  recording.axes = options.axes.value_or(convention.axes);
  recording.up = options.up;
  recording.is_in_world_frame = options.format == RecordingFormat::map_frame;
  FrameFinder(folder, options).find(recording);
  return recording;
}

}  // namespace nbvopt
