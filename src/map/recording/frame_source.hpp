// Where the frames of a map that is built come from.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "nbvopt/map/recording.hpp"

namespace nbvopt {

class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual std::uint64_t frames() const = 0;

  /// Throws InputError, naming the frame, where it cannot be read.
  virtual PosedScan read(std::uint64_t frame) = 0;

  /// What messages call it.
  virtual std::string name(std::uint64_t frame) const = 0;

  /// Adds all that decides what read() gives: the same for the same recording read alike.
  virtual void identify(const std::function<void(std::string_view)>& add) const = 0;
};

/// The frames of a folder.
std::unique_ptr<FrameSource> make_folder_frames(Recording recording);

/// Turns a scan's points from a frame with these axes into its optical frame, and tells
/// T_frame_sensor, a rotation.
Transform to_optical_axes(PoseAxes axes, Scan& scan);

}  // namespace nbvopt
