#include "cli/map_build.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "bag/bag_recording.hpp"
#include "cli/map_output.hpp"
#include "cli/options/arguments.hpp"
#include "cli/options/depth_image_arguments.hpp"
#include "cli/options/robot_file_arguments.hpp"
#include "cli/terminal/end_by_signal.hpp"
#include "cli/terminal/held_signals.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/progress.hpp"
#include "core/atomic_file.hpp"
#include "map/recording/map_builder.hpp"
#include "map/recording/recording_names.hpp"
#include "map/scan_names.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt {
namespace {

struct BuildOptions {
  std::string recording;  ///< a folder, or a rosbag
  std::string output_file;
  std::string format;  ///< of a folder
  std::string pose_file;
  DepthImageArguments depth_image;
  std::string axes;  ///< empty: the convention's
  std::string up = "z";
  std::string topic, camera_info_topic, fixed_frame;  ///< of a rosbag; empty: what it has
  double max_time_difference_s = RecordingOptions{}.max_time_difference_s;
  double resolution_m = 0.05;
  double save_every_s = 30.0;
  RobotFileArguments robot;
  bool is_overwritten = false;
  bool json = false;
};

bool is_bag(const BuildOptions& options) {
  return std::filesystem::exists(options.recording) &&
         !std::filesystem::is_directory(options.recording);
}

/// Throws UsageError for options that say nothing of such a recording.
void check_options(const BuildOptions& options) {
  if (!is_bag(options)) {
    if (options.format.empty()) throw UsageError("--format is required for a folder");
    if (!(options.topic + options.camera_info_topic + options.fixed_frame).empty()) {
      throw UsageError("--topic, --camera-info and --fixed-frame are of a rosbag");
    }
  } else if (!(options.format + options.pose_file).empty() || options.up != "z") {
    throw UsageError("--format, --poses and --up are of a folder, " + options.recording +
                     " is a file");
  }
}

BagOptions bag_options(const BuildOptions& options) {
  return {.topic = options.topic,
          .camera_info_topic = options.camera_info_topic,
          .fixed_frame = options.fixed_frame,
          .fx_fy_cx_cy_px = options.depth_image.fx_fy_cx_cy_px,
          .depth_scale_m = options.depth_image.depth_scale_m,
          .largest_value = enum_value<LargestValue>(options.depth_image.largest_value),
          .axes = enum_value<PoseAxes>(options.axes),
          .max_time_difference_s = options.max_time_difference_s};
}

RecordingOptions recording_options(const BuildOptions& options) {
  return {.format = enum_value<RecordingFormat>(options.format).value(),
          .pose_file = options.pose_file,
          .fx_fy_cx_cy_px = options.depth_image.fx_fy_cx_cy_px,
          .depth_scale_m = options.depth_image.depth_scale_m,
          .largest_value = enum_value<LargestValue>(options.depth_image.largest_value),
          .axes = enum_value<PoseAxes>(options.axes),
          .up = enum_value<UpAxis>(options.up).value(),
          .max_time_difference_s = options.max_time_difference_s};
}

/// Tells what was wrong with the frames that are left out: the first few in full.
class Complaints {
 public:
  void tell(const std::string& complaint, Progress& progress) {
    if (complaint.empty()) return;
    constexpr int kMost = 5;
    if (++count_ > kMost) return;
    progress.finish();
    print_message("warning: left out " + complaint +
                  (count_ == kMost ? " (no more such warnings)" : ""));
    if (first_.empty()) first_ = complaint;
  }
  const std::string& first() const { return first_; }

 private:
  int count_ = 0;
  std::string first_;
};

/// Inserts all frames that are left; the partial file is written now and then, and when the build
/// is told to stop.
void insert_frames(MapBuilder& builder, std::uint64_t frames, const BuildOptions& options) {
  using Clock = std::chrono::steady_clock;
  const std::chrono::duration<double> between(options.save_every_s);
  Clock::time_point saved = Clock::now();
  Progress progress("building", static_cast<double>(frames));
  Complaints complaints;
  std::optional<int> stopped_by;
  {
    const HeldSignals signals;
    while (!builder.is_done() && !stopped_by) {
      complaints.tell(builder.insert_next_frame(), progress);
      progress.update(static_cast<double>(builder.frames_done()));
      stopped_by = signals.take();
      if (stopped_by || Clock::now() - saved >= between) {
        builder.save();
        saved = Clock::now();
      }
    }
  }
  progress.finish();
  if (stopped_by) end_by(*stopped_by);
  if (builder.counts().frames_inserted == 0) {
    throw InputError("no frame could be inserted, the first one because of " + complaints.first());
  }
}

Json counts_json(const BuildCounts& counts) {
  return {{"frames_inserted", counts.frames_inserted},
          {"frames_none_in_range", counts.frames_none_in_range},
          {"frames_unreadable", counts.frames_unreadable},
          {"points_used", counts.points_used},
          {"points_too_near", counts.points_too_near},
          {"points_too_far", counts.points_too_far},
          {"no_returns", counts.no_returns},
          {"points_not_finite", counts.points_not_finite},
          {"points_off_lattice", counts.points_off_lattice}};
}

std::string counts_text(const BuildCounts& counts, std::uint64_t without_pose) {
  std::string text = std::to_string(counts.frames_inserted) + " frames inserted";
  for (const auto& [count, what] : {std::pair{without_pose, " without a pose"},
                                    {counts.frames_none_in_range, " without a point in range"},
                                    {counts.frames_unreadable, " that cannot be read"}}) {
    if (count > 0) text += ", " + std::to_string(count) + what;
  }
  return text + "\n" + std::to_string(counts.points_used) + " points used, " +
         std::to_string(counts.points_too_near) + " too near, " +
         std::to_string(counts.points_too_far) + " too far, " + std::to_string(counts.no_returns) +
         " without return, " + std::to_string(counts.points_not_finite) + " not finite\n";
}

/// A recording's frames, and what is told of it.
struct FoundFrames {
  std::unique_ptr<FrameSource> frames;
  std::uint64_t without_pose = 0;
  Json told;
};

FoundFrames find_frames(const BuildOptions& options) {
  if (!is_bag(options)) {
    auto recording = find_recording(options.recording, recording_options(options));
    const std::uint64_t without_pose = recording.frames_without_pose;
    return {make_folder_frames(std::move(recording)), without_pose, {{"format", options.format}}};
  }
  auto bag = std::make_unique<BagRecording>(options.recording, bag_options(options));
  const BagSummary summary = bag->summary();
  print_message(summary.topic + " (" + summary.type + ") in the frame '" + summary.sensor_frame +
                "', mapped in '" + summary.fixed_frame + "'");
  return {std::move(bag),
          summary.frames_without_pose,
          {{"format", "rosbag"},
           {"topic", summary.topic},
           {"fixed_frame", summary.fixed_frame},
           {"sensor_frame", summary.sensor_frame}}};
}

void run_build(const BuildOptions& options) {
  namespace fs = std::filesystem;
  check_options(options);
  const MapFormat format = map_format("", options.output_file);
  if (!options.is_overwritten && fs::exists(options.output_file)) {
    throw InputError(options.output_file + ": is there already, give another name or --overwrite");
  }
  require_writable(options.output_file);
  const Robot robot = read_robot(options.robot, {});
  FoundFrames found = find_frames(options);
  const std::uint64_t frames = found.frames->frames();
  const fs::path partial_file = options.output_file + ".partial";
  MapBuilder builder(std::move(found.frames), robot.sensor, options.resolution_m, partial_file);
  const std::uint64_t resumed_at = builder.frames_done();
  if (resumed_at > 0) {
    print_message("goes on after " + std::to_string(resumed_at) + " frames, kept in " +
                  partial_file.string());
  }
  insert_frames(builder, frames, options);
  write_map(builder.map(), options.output_file, format);
  std::error_code ignored;
  fs::remove(partial_file, ignored);

  if (options.json) {
    Json json{{"recording", options.recording},
              {"out", options.output_file},
              {"frames_without_pose", found.without_pose},
              {"frames_resumed", resumed_at}};
    json.update(found.told);
    json.update(counts_json(builder.counts()));
    json.update(map_json(builder.map()));
    print_answer(to_text(json));
  } else {
    print_answer(counts_text(builder.counts(), found.without_pose) + map_text(builder.map()));
  }
}

void add_recording_arguments(CLI::App& build, BuildOptions& options) {
  build
      .add_option("RECORDING", options.recording, "the folder of a recording, or a rosbag (ROS 1)")
      ->required();
  build.add_option("OUT", options.output_file, "the map to write: .ot or .bt")->required();
  build.add_option("--format", options.format, "how a folder is laid out")
      ->check(CLI::IsMember(enum_names<RecordingFormat>()))
      ->type_name("NAME");
  build
      .add_option("--poses", options.pose_file,
                  "the pose file [where the convention has it, in RECORDING]")
      ->type_name("FILE");
  add_depth_image_arguments(build, options.depth_image, "as the convention has it");
  build
      .add_option("--axes", options.axes,
                  "of the frame that poses speak of: optical (z forward, x right, y down), body (x "
                  "forward, y left, z up), opengl (z backward, y up) [as the convention has it]")
      ->check(CLI::IsMember(enum_names<PoseAxes>()))
      ->type_name("NAME");
  build
      .add_option("--up", options.up,
                  "the axis of the poses' world that points up; the map's z "
                  "does")
      ->check(CLI::IsMember(enum_names<UpAxis>()))
      ->type_name("AXIS")
      ->capture_default_str();
  build
      .add_option("--topic", options.topic,
                  "of a rosbag: PointCloud2 or depth images [the only one there is]")
      ->type_name("TOPIC");
  build
      .add_option("--camera-info", options.camera_info_topic,
                  "of a rosbag's depth images [beside them, or the only one]")
      ->type_name("TOPIC");
  build
      .add_option("--fixed-frame", options.fixed_frame,
                  "of a rosbag: the frame of tf that is mapped [the root above the camera]")
      ->type_name("FRAME");
  add_number(build, "--max-time-difference", options.max_time_difference_s, "S",
             "between a frame and its pose");
}

}  // namespace

void set_up_map_build(CLI::App& map) {
  auto options = std::make_shared<BuildOptions>();
  CLI::App* build = map.add_subcommand("build", "Make a map from a recording");
  add_recording_arguments(*build, *options);
  add_number(*build, "--resolution", options->resolution_m, "M", "the size of the map's voxels");
  add_robot_file(*build, options->robot);
  add_number(*build, "--save-every", options->save_every_s, "S",
             "how often OUT.partial is written, from which a build that was stopped goes on");
  build->add_flag("--overwrite", options->is_overwritten, "replace OUT if it is there");
  build->add_flag("--json", options->json, "print one JSON object instead of text");
  build->footer(
      "Formats: tum, icl-nuim, 7-scenes, scannet, redwood (Open3D), replica and kitti are the\n"
      "layouts of those data sets; named: clouds or depth images with poses.txt, lines 'name or\n"
      "time x y z qx qy qz qw'; viewpoint: PCD files that hold their poses; map-frame: clouds in\n"
      "the map frame, poses as for named (the quaternion may be left out) or as for viewpoint.\n"
      "A rosbag needs none: its clouds or depth images (with camera_info) are placed by tf.\n"
      "Ctrl-C keeps what was done; the same command goes on there.\n"
      "Example: nbvopt map build rgbd_dataset_freiburg1_desk desk.ot --format tum\n"
      "         nbvopt map build drive.bag drive.ot --topic /camera/depth/points");
  build->callback([options] { run_build(*options); });
}

}  // namespace nbvopt
