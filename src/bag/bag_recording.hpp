// The frames of a rosbag: clouds or depth images of one topic, placed by tf.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bag/bag_file.hpp"
#include "map/image_message.hpp"
#include "map/recording/frame_source.hpp"

namespace nbvopt {

/// What overrides what is found.
struct BagOptions {
  std::string topic{};  ///< of the frames; empty: the only one of clouds or depth images
  std::string camera_info_topic{};  ///< empty: that beside the images, or the only one
  std::string fixed_frame{};        ///< the map's; empty: the root of tf above the camera
  std::optional<std::array<double, 4>> fx_fy_cx_cy_px{};  ///< instead of camera_info
  std::optional<double> depth_scale_m{};
  std::optional<LargestValue> largest_value{};
  /// Of the frame that clouds are in; none: optical where its name has "optical" in it, else body.
  std::optional<PoseAxes> axes{};
  double max_time_difference_s = 0.02;  ///< between a frame and the first or last of tf
};

/// What was found in a bag.
struct BagSummary {
  std::string topic, type;
  std::string fixed_frame, sensor_frame;
  std::uint64_t frames_without_pose = 0;
};

class BagRecording : public FrameSource {
 public:
  /// Looks through the bag. Throws InputError where it cannot be read as BagFile has it, holds no
  /// topic of clouds or depth images or several, no camera_info or no tf that fits.
  BagRecording(const std::filesystem::path& path, const BagOptions& options);

  const BagSummary& summary() const { return summary_; }

  std::uint64_t frames() const override { return frames_.size(); }
  PosedScan read(std::uint64_t frame) override;
  std::string name(std::uint64_t frame) const override;
  void identify(const std::function<void(std::string_view)>& add) const override;

 private:
  struct Frame {
    BagPosition where;
    double time_s;
    Transform T_fixed_frame;
  };
  class Survey;

  std::string name_;
  BagFile bag_;
  BagSummary summary_;
  std::optional<DepthImageOptions> depth_image_;  ///< none: frames are clouds
  std::optional<CameraInfoMessage> camera_info_;  ///< of the images; none: intrinsics were given
  PoseAxes axes_ = PoseAxes::optical;
  std::vector<Frame> frames_;
};

}  // namespace nbvopt
