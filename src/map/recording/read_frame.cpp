#include <fstream>

#include "core/input_file.hpp"
#include "map/byte_reader.hpp"
#include "map/recording/frame_files.hpp"
#include "map/recording/frame_source.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/recording.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

Eigen::Matrix3d rotation_frame_sensor(PoseAxes axes) {
  switch (axes) {
    case PoseAxes::optical:
      break;
    case PoseAxes::body:
      return rotation_body_sensor();
    case PoseAxes::opengl:
      return Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  }
  return Eigen::Matrix3d::Identity();
}

/// Quarter or half a turn: whole numbers, so that nothing is rounded.
Eigen::Matrix3d rotation_map_world(UpAxis up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  switch (up) {
    case UpAxis::plus_z:
      break;
    case UpAxis::minus_z:
      R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
      break;
    case UpAxis::plus_y:
      R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
      break;
    case UpAxis::minus_y:
      R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      break;
    case UpAxis::plus_x:
      R << 0, 0, -1, 0, 1, 0, 1, 0, 0;
      break;
    case UpAxis::minus_x:
      R << 0, 0, 1, 0, 1, 0, -1, 0, 0;
      break;
  }
  return R;
}

/// KITTI's laser scans: x, y, z and reflectance, four floats a point.
Scan read_laser_scan(const std::filesystem::path& file) {
  if (file.filename().string().ends_with(".pcd.bin")) {
    throw InputError(file.string() +
                     ": has five numbers a point, as nuScenes has it, not KITTI's "
                     "four: make it a PCD file");
  }
  constexpr std::size_t kPointBytes = 4 * sizeof(float);
  std::ifstream in = open_input_file(file);
  ByteReader bytes(in);
  Scan scan;
  while (!bytes.at_end()) {
    const char* point = bytes.take(kPointBytes);
    if (point == nullptr) {
      throw InputError(file.string() + ": the file ends within a point, it is truncated");
    }
    scan.points_m.emplace_back(number_at<float>(point), number_at<float>(point + 4),
                               number_at<float>(point + 8));
  }
  return scan;
}

/// The optical frame there that looks at the middle of the points, level.
Eigen::Matrix3d looking_at_points(const Scan& scan, const Eigen::Vector3d& position) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : scan.points_m) {
    if (p.allFinite()) sum += p.cast<double>() - position;
  }
  constexpr double kAlmostNothing = 1e-6;
  if (sum.norm() < kAlmostNothing) return rotation_body_sensor();
  const Eigen::Vector3d forward = sum.normalized();
  Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ());
  if (right.norm() < kAlmostNothing) right = -Eigen::Vector3d::UnitY();
  Eigen::Matrix3d R;
  R.col(0) = right.normalized();
  R.col(1) = forward.cross(R.col(0));
  R.col(2) = forward;
  return R;
}

void transform_points(const Transform& T, Scan& scan) {
  for (Eigen::Vector3f& p : scan.points_m) p = (T * p.cast<double>()).cast<float>();
}

}  // namespace

Transform to_optical_axes(PoseAxes axes, Scan& scan) {
  Transform T_frame_sensor = Transform::Identity();
  if (axes == PoseAxes::optical) return T_frame_sensor;
  T_frame_sensor.rotate(rotation_frame_sensor(axes));
  transform_points(T_frame_sensor.inverse(), scan);
  return T_frame_sensor;
}

PosedScan read_frame(const Recording& recording, const RecordedFrame& frame) {
  const bool is_cloud = !is_depth_image(frame.file);
  PosedScan posed{.scan = frame.file.extension() == ".bin"
                              ? read_laser_scan(frame.file)
                              : read_scan(frame.file, recording.depth_image)};
  Transform T_map_world = Transform::Identity();
  T_map_world.rotate(rotation_map_world(recording.up));
  Transform T_world_sensor = frame.T_world_frame;
  if (!frame.has_orientation) {
    T_world_sensor.rotate(looking_at_points(posed.scan, T_world_sensor.translation()));
  } else {
    T_world_sensor.rotate(rotation_frame_sensor(recording.axes));
  }
  if (is_cloud && recording.is_in_world_frame) {
    transform_points(T_world_sensor.inverse(), posed.scan);
  } else if (is_cloud) {
    to_optical_axes(recording.axes, posed.scan);
  }
  posed.T_map_sensor = T_map_world * T_world_sensor;
  return posed;
}

}  // namespace nbvopt
