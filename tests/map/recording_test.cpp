// Recordings in each convention, made here: the map that a builder makes of one equals that of
// frames inserted by hand, and a build that was stopped goes on to the same map.
#include "nbvopt/map/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <iomanip>
#include <sstream>

#include "map/recording/map_builder.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan_file.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kVoxel_m = 0.05;
constexpr int kFrames = 3;

Transform place(int i) {
  return pose_from_quaternion({0.1 * i, -0.05 * i, 0.4}, {0.5, -0.5, 0.5, -0.5 - 0.02 * i});
}

std::string text_of(const std::vector<double>& numbers) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const double number : numbers) text << ' ' << number;
  return text.str().substr(1);
}

/// "x y z qx qy qz qw", the quaternion not of length 1.
std::string quaternion_text(const Transform& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d p = T.translation();
  return text_of({p.x(), p.y(), p.z(), 2 * q.x(), 2 * q.y(), 2 * q.z(), 2 * q.w()});
}

/// Rows of a 4 x 4 matrix with `between` them.
std::string matrix_text(const Transform& T, const char* between, int rows = 4) {
  std::string text;
  for (int r = 0; r < rows; ++r) {
    text += (r > 0 ? between : "") +
            text_of({T.matrix()(r, 0), T.matrix()(r, 1), T.matrix()(r, 2), T.matrix()(r, 3)});
  }
  return text;
}

class RecordingTest : public ::testing::Test {
 protected:
  /// Writes a depth image of a wall that leans, with a pixel that is not known and one of the
  /// largest value. A plain PGM whatever its name: readers go by the content.
  void write_image(const std::string& name, double scale_m, int frame) {
    std::string text = "P2\n8 6\n65535\n";
    for (int p = 0; p < 8 * 6; ++p) {
      const int depth = static_cast<int>((1.4 + 0.01 * p + 0.1 * frame) / scale_m);
      text += std::to_string(p == 3 ? 0 : p == 5 ? 65535 : depth) + ' ';
    }
    write(name, text);
  }

  std::string write(const std::string& name, const std::string& content) {
    fs::create_directories(fs::path(folder / name).parent_path());
    return folder.write(name, content);
  }

  /// A cloud of the same points for every frame, moved by T.
  std::string cloud_text(const Transform& T = Transform::Identity()) {
    std::string text;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d p = T * Eigen::Vector3d(0.05 * i - 0.5, 0.02 * i, 1.5 + 0.03 * i);
      text += text_of({p.x(), p.y(), p.z()}) + '\n';
    }
    return text;
  }

  void insert_by_hand(const Scan& scan, const Transform& T_map_sensor) {
    insert_scan(by_hand, scan, T_map_sensor, {});
  }

  Scan image(const std::string& name, const DepthImageOptions& camera) {
    return read_scan(folder / name, camera);
  }

  void expect_the_map_by_hand(const RecordingOptions& options, std::uint64_t without_pose = 0) {
    const Recording recording = find_recording(folder.path(), options);
    EXPECT_EQ(recording.frames_without_pose, without_pose);
    MapBuilder builder(make_folder_frames(recording), {}, kVoxel_m, folder / "map.partial");
    while (!builder.is_done()) EXPECT_EQ(builder.insert_next_frame(), "");
    EXPECT_EQ(builder.counts().frames_inserted, static_cast<std::uint64_t>(kFrames));
    expect_equal(builder.map(), by_hand);
  }

  /// Voxel by voxel; and what was inserted is more than nothing.
  static void expect_equal(const UncertaintyMap& a, const UncertaintyMap& b) {
    EXPECT_GT(b.counts().occupied_voxels, 10U);
    EXPECT_TRUE(map_file_bytes(a, MapFormat::uncertainty_ot) ==
                map_file_bytes(b, MapFormat::uncertainty_ot));
  }

  test::TemporaryFolder folder;
  UncertaintyMap by_hand{kVoxel_m};
};

TEST_F(RecordingTest, Tum) {
  DepthImageOptions camera{.fx_px = 525.0, .fy_px = 525.0, .cx_px = 319.5, .cy_px = 239.5};
  camera.depth_scale_m = 1.0 / 5000.0;
  camera.largest_value = LargestValue::far;
  std::string list = "# depth images\n";
  std::string poses = "# timestamp tx ty tz qx qy qz qw\n1305031449.00 9 9 9 0 0 0 1\n";
  for (int i = 0; i < kFrames; ++i) {
    const std::string time = "130503145" + std::to_string(i);
    write_image("depth/" + time + ".1.png", camera.depth_scale_m, i);
    list += time + ".1 depth/" + time + ".1.png\n";
    poses += time + ".13 8 8 8 0 0 0 1\n" + time + ".115 " + quaternion_text(place(i)) + "\n";
    insert_by_hand(image("depth/" + time + ".1.png", camera), place(i));
  }
  write_image("depth/1305031459.1.png", camera.depth_scale_m, 0);
  write("groundtruth.txt", poses);
  expect_the_map_by_hand({.format = RecordingFormat::tum}, 1);  // by the files' names
  write("depth.txt", list);
  expect_the_map_by_hand({.format = RecordingFormat::tum});
  fs::remove(folder / "depth.txt");
  fs::create_directory(folder / "rgb");
  write("associations.txt",
        "1305031450.09 rgb/1.png 1305031450.1 depth/1305031450.1.png\n"
        "1305031451.09 rgb/2.png 1305031451.1 depth/1305031451.1.png\n"
        "1305031452.09 rgb/3.png 1305031452.1 depth/1305031452.1.png\n");
  expect_the_map_by_hand({.format = RecordingFormat::tum});
  RecordingOptions strict{.format = RecordingFormat::tum};
  strict.max_time_difference_s = 0.001;
  EXPECT_THAT(test::message_of<InputError>([&] { find_recording(folder.path(), strict); }),
              HasSubstr("max_time_difference_s, 0.001"));
}

TEST_F(RecordingTest, TumKnowsItsCameras) {
  write_image("rgbd_dataset_freiburg2_xyz/depth/1.png", 0.0002, 0);
  write("rgbd_dataset_freiburg2_xyz/groundtruth.txt", "1 0 0 0 0 0 0 1\n");
  const Recording recording = find_recording(folder / "rgbd_dataset_freiburg2_xyz", {});
  EXPECT_EQ(recording.depth_image->fx_px, 520.9);
  EXPECT_EQ(recording.depth_image->cy_px, 249.7);
}

TEST_F(RecordingTest, IclNuim) {
  DepthImageOptions camera{.fx_px = 481.2, .fy_px = -480.0, .cx_px = 319.5, .cy_px = 239.5};
  camera.depth_scale_m = 1.0 / 5000.0;
  camera.largest_value = LargestValue::far;
  std::string poses;
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = std::to_string(9 + i);  // 10 after 9
    write_image("depth/" + name + ".png", camera.depth_scale_m, i);
    poses += name + ' ' + quaternion_text(place(i)) + '\n';
    insert_by_hand(image("depth/" + name + ".png", camera), place(i));
  }
  write("livingRoom0.gt.freiburg", poses);
  expect_the_map_by_hand({.format = RecordingFormat::icl_nuim});
}

TEST_F(RecordingTest, SevenScenes) {
  DepthImageOptions camera{.fx_px = 585.0, .fy_px = 585.0, .cx_px = 320.0, .cy_px = 240.0};
  camera.largest_value = LargestValue::invalid;
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = "frame-00000" + std::to_string(i);
    write_image(name + ".depth.png", 0.001, i);
    write(name + ".color.png", "not read");
    write(name + ".pose.txt", matrix_text(place(i), " \t\n") + "\n");
    insert_by_hand(image(name + ".depth.png", camera), place(i));
  }
  write_image("frame-000003.depth.png", 0.001, 0);
  expect_the_map_by_hand({.format = RecordingFormat::seven_scenes}, 1);
}

TEST_F(RecordingTest, Scannet) {
  DepthImageOptions camera{.fx_px = 571.6, .fy_px = 571.7, .cx_px = 319.4, .cy_px = 239.6};
  camera.largest_value = LargestValue::far;
  write("intrinsic/intrinsic_depth.txt", "571.6 0 319.4 0\n0 571.7 239.6 0\n0 0 1 0\n0 0 0 1\n");
  for (int i = 0; i < kFrames; ++i) {
    write_image("depth/" + std::to_string(i) + ".png", 0.001, i);
    write("pose/" + std::to_string(i) + ".txt", matrix_text(place(i), "\n") + "\n");
    insert_by_hand(image("depth/" + std::to_string(i) + ".png", camera), place(i));
  }
  write_image("depth/3.png", 0.001, 0);
  write("pose/3.txt", "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n0 0 0 1\n");
  expect_the_map_by_hand({.format = RecordingFormat::scannet}, 1);
}

TEST_F(RecordingTest, Redwood) {
  DepthImageOptions camera{.fx_px = 525.0, .fy_px = 525.0, .cx_px = 319.5, .cy_px = 239.5};
  camera.largest_value = LargestValue::far;
  std::string poses;
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = "depth/00000" + std::to_string(i + 1) + ".png";
    write_image(name, 0.001, i);
    const std::string number = std::to_string(i);
    poses += number + ' ' + number + ' ' + std::to_string(i + 1) + '\n' +
             matrix_text(place(i), "\n") + '\n';
    insert_by_hand(image(name, camera), place(i));
  }
  write("trajectory.log", poses);
  expect_the_map_by_hand({.format = RecordingFormat::redwood});
}

TEST_F(RecordingTest, Replica) {
  DepthImageOptions camera{.fx_px = 600.0, .fy_px = 600.0, .cx_px = 599.5, .cy_px = 339.5};
  camera.depth_scale_m = 1.0 / 6553.5;
  camera.largest_value = LargestValue::far;
  std::string poses;
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = "results/depth00000" + std::to_string(i) + ".png";
    write_image(name, camera.depth_scale_m, i);
    write("results/frame00000" + std::to_string(i) + ".jpg", "not read");
    poses += matrix_text(place(i), " ") + '\n';
    insert_by_hand(image(name, camera), place(i));
  }
  write("traj.txt", poses);
  expect_the_map_by_hand({.format = RecordingFormat::replica});
}

TEST_F(RecordingTest, Kitti) {
  // The laser's x is the camera's z: body axes on a mast behind the camera.
  Transform T_camera_laser = Transform::Identity();
  T_camera_laser.translate(Eigen::Vector3d(0.0, -0.1, -0.25));
  T_camera_laser.rotate(rotation_body_sensor().transpose().eval());
  write("calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: " + matrix_text(T_camera_laser, " ", 3));
  Scan scan;
  std::string cloud;
  for (int i = 0; i < 20; ++i) {
    const std::array<float, 4> point{1.5F + 0.03F * i, 0.05F * i - 0.5F, 0.02F * i, 0.5F};
    cloud.append(reinterpret_cast<const char*>(point.data()), sizeof point);
    scan.points_m.emplace_back(-point[1], -point[2], point[0]);  // in the optical frame
  }
  std::string poses;
  for (int i = 0; i < kFrames; ++i) {
    write("velodyne/00000" + std::to_string(i) + ".bin", cloud);
    poses += matrix_text(place(i), " ", 3) + '\n';
    Transform T_map_sensor = place(i) * T_camera_laser;
    T_map_sensor.rotate(rotation_body_sensor());
    insert_by_hand(scan, T_map_sensor);
  }
  write("poses.txt", poses);
  expect_the_map_by_hand({.format = RecordingFormat::kitti});
}

TEST_F(RecordingTest, KittiIsNotNuScenes) {
  write("calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  write("velodyne/0.pcd.bin", std::string(80, '\0'));  // twenty numbers: both would fit
  const Recording recording = find_recording(folder.path(), {.format = RecordingFormat::kitti});
  EXPECT_THAT(test::message_of<InputError>([&] { read_frame(recording, recording.frames[0]); }),
              HasSubstr("nuScenes"));
}

TEST_F(RecordingTest, NamedOrTimedClouds) {
  std::string by_name;
  std::string by_time;
  for (int i = 0; i < kFrames; ++i) {
    const std::string stem = "1" + std::to_string(i) + ".5";
    insert_by_hand(read_scan(write(stem + ".xyz", cloud_text())), place(i));
    by_name += stem + (i == 0 ? "" : ".xyz") + ',' + quaternion_text(place(i)) + '\n';
    by_time += "1" + std::to_string(i) + ".51 " + quaternion_text(place(i)) + " # a remark\n";
  }
  write("99.xyz", cloud_text());
  write("poses.txt", by_name);
  expect_the_map_by_hand({.format = RecordingFormat::named}, 1);
  RecordingOptions timed{.format = RecordingFormat::named};
  timed.pose_file = write("times/theirs.txt", by_time);
  expect_the_map_by_hand(timed, 1);
}

TEST_F(RecordingTest, AxesAndUp) {
  // Poses of a camera as OpenGL has them, in a world whose y points up.
  const DepthImageOptions camera{.fx_px = 8.0, .fy_px = 8.0, .cx_px = 3.5, .cy_px = 2.5};
  Transform T_map_world = Transform::Identity();
  T_map_world.rotate(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitX()));
  Transform T_gl_sensor = Transform::Identity();
  T_gl_sensor.rotate(Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitX()));
  std::string poses;
  for (int i = 0; i < kFrames; ++i) {
    const std::string name = std::to_string(i) + ".pgm";
    write_image(name, 0.001, i);
    insert_by_hand(image(name, camera), place(i));
    poses += name + ' ' +
             quaternion_text(T_map_world.inverse() * place(i) * T_gl_sensor.inverse()) + '\n';
  }
  write("poses.txt", poses);
  RecordingOptions options{.format = RecordingFormat::named};
  options.fx_fy_cx_cy_px = {8.0, 8.0, 3.5, 2.5};
  options.axes = PoseAxes::opengl;
  options.up = UpAxis::plus_y;
  expect_the_map_by_hand(options);
}

std::string pcd_text(const std::string& viewpoint, const std::string& points) {
  return "FIELDS x y z\n" + viewpoint + "POINTS 20\nDATA ascii\n" + points;
}

std::string viewpoint_text(const Transform& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d p = T.translation();
  return "VIEWPOINT " + text_of({p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) + "\n";
}

TEST_F(RecordingTest, Viewpoints) {
  for (int i = 0; i < kFrames; ++i) {
    const std::string file =
        write(std::to_string(i) + ".pcd", pcd_text(viewpoint_text(place(i)), cloud_text()));
    insert_by_hand(read_scan(file), place(i));
  }
  write("9.pcd", pcd_text("", cloud_text()));
  expect_the_map_by_hand({.format = RecordingFormat::viewpoint}, 1);
}

TEST_F(RecordingTest, CloudsInTheMapFrame) {
  std::string origins;
  for (int i = 0; i < kFrames; ++i) {
    const std::string stem = std::to_string(i);
    Scan scan =
        read_scan(write(stem + ".pcd", pcd_text(viewpoint_text(place(i)), cloud_text(place(i)))));
    for (Eigen::Vector3f& p : scan.points_m) {
      p = (place(i).inverse() * p.cast<double>()).cast<float>();
    }
    insert_by_hand(scan, place(i));
    const Eigen::Vector3d origin = place(i).translation();
    origins += stem + ' ' + text_of({origin.x(), origin.y(), origin.z()}) + '\n';
  }
  expect_the_map_by_hand({.format = RecordingFormat::map_frame});

  // Without orientation: the same voxels, seen straight ahead.
  RecordingOptions options{.format = RecordingFormat::map_frame};
  options.pose_file = write("origins/poses.txt", origins);
  const Recording recording = find_recording(folder.path(), options);
  MapBuilder builder(make_folder_frames(recording), {}, kVoxel_m, folder / "map.partial");
  while (!builder.is_done()) EXPECT_EQ(builder.insert_next_frame(), "");
  EXPECT_NEAR(builder.map().counts().occupied_voxels, by_hand.counts().occupied_voxels, 2)
      << "but for rounding at the faces of voxels";
  EXPECT_GT(builder.map().counts().information, by_hand.counts().information);
}

class StoppedBuild : public RecordingTest {
 protected:
  StoppedBuild() {
    std::string poses;
    for (int i = 0; i < 5; ++i) {
      write(std::to_string(i) + ".xyz", cloud_text());
      poses += std::to_string(i) + ' ' + quaternion_text(place(i)) + '\n';
    }
    write("poses.txt", poses);
  }

  Recording recording() {
    return find_recording(folder.path(), {.format = RecordingFormat::named});
  }
  const std::string partial = folder / "map.partial";
};

TEST_F(StoppedBuild, GoesOnWhereItWas) {
  const Recording frames = recording();
  MapBuilder whole(make_folder_frames(frames), {}, kVoxel_m, partial);
  while (!whole.is_done()) whole.insert_next_frame();
  {
    MapBuilder first(make_folder_frames(frames), {}, kVoxel_m, partial);
    first.insert_next_frame();
    first.insert_next_frame();
    first.save();
    first.insert_next_frame();  // is lost
  }
  EXPECT_NO_THROW(read_map(partial)) << "what is there can be looked at";
  MapBuilder second(make_folder_frames(frames), {}, kVoxel_m, partial);
  EXPECT_EQ(second.frames_done(), 2U);
  while (!second.is_done()) second.insert_next_frame();
  EXPECT_EQ(second.counts(), whole.counts());
  expect_equal(second.map(), whole.map());
}

TEST_F(StoppedBuild, IsNotTakenForAnother) {
  const Recording frames = recording();
  MapBuilder(make_folder_frames(frames), {}, kVoxel_m, partial).save();
  const auto refusal = [&](const Recording& other, const SensorOptions& sensor, double voxel_m) {
    return test::message_of<InputError>(
        [&] { MapBuilder(make_folder_frames(other), sensor, voxel_m, partial); });
  };
  EXPECT_EQ(refusal(frames, {}, kVoxel_m), "");
  EXPECT_THAT(refusal(frames, {}, 0.1), HasSubstr("another build"));
  SensorOptions farther;
  farther.range_max_m = 5.0;
  EXPECT_THAT(refusal(frames, farther, kVoxel_m), HasSubstr("another build"));
  Recording moved = frames;
  moved.frames.back().T_world_frame.translation().x() += 1e-9;
  EXPECT_THAT(refusal(moved, {}, kVoxel_m), HasSubstr("another build"));
  folder.write("map.partial", "# Octomap OcTree file\n# by hand\nid OcTree\n");
  EXPECT_THAT(refusal(frames, {}, kVoxel_m), HasSubstr("another build"));
}

TEST_F(StoppedBuild, LeavesOutFramesThatItSaysAreBad) {
  write("1.xyz", "1 2 three\n");
  write("3.xyz", "0 0 1500\n");
  const Recording frames = recording();
  MapBuilder builder(make_folder_frames(frames), {}, kVoxel_m, partial);
  EXPECT_EQ(builder.insert_next_frame(), "");
  EXPECT_THAT(builder.insert_next_frame(), HasSubstr("1.xyz: line 1"));
  EXPECT_EQ(builder.insert_next_frame(), "");
  EXPECT_THAT(builder.insert_next_frame(), HasSubstr("3.xyz: no point is between"));
  EXPECT_EQ(builder.counts().frames_inserted, 2U);
  EXPECT_EQ(builder.counts().frames_unreadable, 1U);
  EXPECT_EQ(builder.counts().frames_none_in_range, 1U);
}

TEST_F(RecordingTest, RefusesWhatIsNotThere) {
  const auto refusal = [&](RecordingFormat format) {
    return test::message_of<InputError>([&] { find_recording(folder.path(), {.format = format}); });
  };
  EXPECT_THAT(refusal(RecordingFormat::tum), HasSubstr("depth"));
  write_image("depth/1.png", 0.001, 0);
  EXPECT_THAT(refusal(RecordingFormat::tum), HasSubstr("groundtruth.txt"));
  EXPECT_THAT(refusal(RecordingFormat::icl_nuim), HasSubstr("*.gt.freiburg"));
  write("groundtruth.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0\n");
  EXPECT_THAT(refusal(RecordingFormat::tum), HasSubstr("groundtruth.txt: line 2"));
  write("groundtruth.txt", "1 0 0 0 0 0 0 0\n");
  EXPECT_THAT(refusal(RecordingFormat::tum), HasSubstr("line 1: orientation_xyzw"));
  write("groundtruth.txt", "7 0 0 0 0 0 0 1\n");
  EXPECT_THAT(refusal(RecordingFormat::tum), HasSubstr("none of its 1 frames has a pose"));
  write("trajectory.log", "0 0 1\n2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_THAT(refusal(RecordingFormat::redwood), HasSubstr("line 5: the matrix"));
  write("trajectory.log", "0 0 1\n1 0 0 0\n0 1 0 0\n");
  EXPECT_THAT(refusal(RecordingFormat::redwood), HasSubstr("not complete"));
}

}  // namespace
}  // namespace nbvopt
