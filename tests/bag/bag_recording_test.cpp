// The map that a bag makes equals that of its frames inserted by hand.
#include "bag/bag_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "bag/made_bag.hpp"
#include "map/recording/map_builder.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kFrames = 4;
constexpr double kVoxel_m = 0.05;
constexpr const char* kCloud = "sensor_msgs/PointCloud2";
constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCompressedImage = "sensor_msgs/CompressedImage";
constexpr const char* kCameraInfo = "sensor_msgs/CameraInfo";
constexpr const char* kTf = "tf2_msgs/TFMessage";

Transform T_base_camera() {
  Transform T = base_pose(0.1, 0.0, 0.4, 0.0);
  T.rotate(rotation_body_sensor());
  return T;
}

/// Points of a wall, in the optical frame.
std::vector<Eigen::Vector3f> wall(int frame) {
  std::vector<Eigen::Vector3f> points_m;
  for (int i = -5; i <= 5; ++i) {
    points_m.emplace_back(0.1F * static_cast<float>(i), 0.05F,
                          1.5F + 0.1F * static_cast<float>(frame));
  }
  return points_m;
}

Scan scan_of_wall(int frame) {
  Scan scan;
  scan.points_m = wall(frame);
  return scan;
}

/// Depths of a slanted wall in millimetres, eighths of a metre; one is not known, one is nothing in
/// range.
std::vector<std::uint16_t> depths() {
  std::vector<std::uint16_t> pixels;
  for (int i = 0; i < 12; ++i) pixels.push_back(static_cast<std::uint16_t>(1000 + 125 * i));
  pixels[3] = 0;
  pixels[7] = 65535;
  return pixels;
}

/// The camera of these images, 4 x 3 pixels.
constexpr DepthImageOptions kCamera{.fx_px = 5.0, .fy_px = 5.0, .cx_px = 1.5, .cy_px = 1.0};

std::string camera_info() {
  return test::camera_info_message(10.5, "camera_optical", 5.0, 1.5, 1.0);
}

/// Of the colour camera beside it.
std::string other_camera_info() {
  return test::camera_info_message(10.5, "colour_optical", 7.0, 2.0, 2.0);
}

Scan scan_of_depths() {
  Scan scan;
  for (std::uint32_t row = 0; row < 3; ++row) {
    const auto pixels = depths();
    append_depth_row(std::span(pixels).subspan(4 * row, 4), row, kCamera, scan);
  }
  return scan;
}

/// 4 x 3 pixels.
std::string png_of(const std::vector<std::uint16_t>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 4;
  image.height = 3;
  image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t bytes = 0;
  png_image_write_to_memory(&image, nullptr, &bytes, 0, pixels.data(), 0, nullptr);
  std::string png(bytes, '\0');
  png_image_write_to_memory(&image, png.data(), &bytes, 0, pixels.data(), 0, nullptr);
  return png;
}

/// What compressedDepth puts before a PNG.
std::string quantisation(float a, float b) {
  return test::bytes_of(std::uint32_t{0}) + test::bytes_of(a) + test::bytes_of(b);
}

class BagRecordingTest : public ::testing::Test {
 protected:
  /// A base that drives while its camera looks; tf comes half way between the frames.
  static test::MadeBag drive() {
    test::MadeBag bag;
    bag.add("/tf_static", kTf, test::tf_message(0, "base", "camera_optical", T_base_camera()));
    for (int i = 0; i <= kFrames; ++i) {
      bag.add("/tf", kTf, test::tf_message(10.0 + i, "odom", "base", base_pose(0.2 * i, 0, 0, 0)));
    }
    return bag;
  }

  /// Where the camera is at the time of a frame.
  static Transform T_odom_camera(int frame) {
    return base_pose(0.2 * (frame + 0.5), 0, 0, 0) * T_base_camera();
  }

  std::unique_ptr<BagRecording> recording(const test::MadeBag& bag,
                                          const BagOptions& options = {}) const {
    return std::make_unique<BagRecording>(folder.write("drive.bag", bag.file()), options);
  }

  std::string refusal(const test::MadeBag& bag, const BagOptions& options = {}) const {
    return test::message_of<InputError>([&] { recording(bag, options); });
  }

  void expect_map(std::unique_ptr<FrameSource> frames,
                  const std::function<Scan(int frame)>& scan) const {
    MapBuilder builder(std::move(frames), {}, kVoxel_m, folder / "partial");
    while (!builder.is_done()) EXPECT_EQ(builder.insert_next_frame(), "");
    UncertaintyMap expected(kVoxel_m);
    for (int i = 0; i < kFrames; ++i) insert_scan(expected, scan(i), T_odom_camera(i), {});
    EXPECT_TRUE(map_file_bytes(builder.map(), MapFormat::uncertainty_ot) ==
                map_file_bytes(expected, MapFormat::uncertainty_ot));
  }

  test::TemporaryFolder folder;
};

TEST_F(BagRecordingTest, PlacesCloudsByTf) {
  test::MadeBag bag = drive();
  for (int i = 0; i < kFrames; ++i) {
    bag.add("/points", kCloud, test::cloud_message(10.5 + i, "camera_optical", wall(i)));
  }
  auto found = recording(bag);
  EXPECT_EQ(found->summary().fixed_frame, "odom");
  EXPECT_EQ(found->summary().topic, "/points");
  EXPECT_EQ(found->frames(), static_cast<std::uint64_t>(kFrames));
  expect_map(std::move(found), [](int i) { return scan_of_wall(i); });
}

TEST_F(BagRecordingTest, TurnsCloudsOfBodyAxes) {
  test::MadeBag bag = drive();
  Transform T_optical_body = Transform::Identity();
  T_optical_body.rotate(rotation_body_sensor().transpose().eval());
  bag.add("/tf_static", kTf, test::tf_message(0, "camera_optical", "camera_link", T_optical_body));
  for (int i = 0; i < kFrames; ++i) {
    std::vector<Eigen::Vector3f> points_m = wall(i);
    for (auto& p : points_m) p = T_optical_body.inverse().cast<float>() * p;
    bag.add("/points", kCloud, test::cloud_message(10.5 + i, "camera_link", points_m));
  }
  expect_map(recording(bag), [](int i) { return scan_of_wall(i); });
}

TEST_F(BagRecordingTest, ReadsDepthImages) {
  const Scan expected = scan_of_depths();
  ASSERT_EQ(expected.no_returns.size(), 1U);
  for (const bool is_metres : {false, true}) {
    test::MadeBag bag = drive();
    std::string data;
    for (const std::uint16_t depth : depths()) {
      const float depth_m = depth == 65535 ? test::kInfinity
                            : depth == 0   ? test::kNaN
                                           : static_cast<float>(depth) / 1000.0F;
      is_metres ? append(data, depth_m) : append(data, depth);
    }
    for (int i = 0; i < kFrames; ++i) {
      const double time_s = 10.5 + i;
      bag.add("/colour/camera_info", kCameraInfo, other_camera_info());
      bag.add("/depth/camera_info", kCameraInfo, camera_info());
      bag.add(
          "/depth/image", kImage,
          test::image_message(time_s, "camera_optical", 4, 3, is_metres ? "32FC1" : "16UC1", data));
      bag.add("/colour/image", kImage,
              test::image_message(time_s, "camera_optical", 4, 3, "rgb8", std::string(36, 'c')));
    }
    expect_map(recording(bag), [&](int) { return expected; });
  }
}

/// The high byte first, of a camera that tells K alone.
TEST_F(BagRecordingTest, ReadsImagesOfOtherDrivers) {
  std::string data;
  for (const std::uint16_t depth : depths()) {
    data += static_cast<char>(depth >> 8);
    data += static_cast<char>(depth & 0xFF);
  }
  test::MadeBag bag = drive();
  bag.add("/depth/camera_info", kCameraInfo,
          test::camera_info_message(10.5, "camera_optical", 5.0, 1.5, 1.0, false));
  for (int i = 0; i < kFrames; ++i) {
    bag.add("/depth/image", kImage,
            test::image_message(10.5 + i, "camera_optical", 4, 3, "mono16", data, true));
  }
  expect_map(recording(bag), [](int) { return scan_of_depths(); });
}

TEST_F(BagRecordingTest, ReadsCompressedDepthImages) {
  const std::string header = quantisation(0.0F, 0.0F);  // not looked at
  for (const auto& [format, start] :
       {std::pair{"16UC1; compressedDepth", header}, {"16UC1; png compressed ", std::string()}}) {
    test::MadeBag bag = drive();
    bag.add("/colour/camera_info", kCameraInfo, other_camera_info());
    bag.add("/depth/camera_info", kCameraInfo, camera_info());
    for (int i = 0; i < kFrames; ++i) {
      bag.add("/depth/image/packed", kCompressedImage,
              test::compressed_image_message(10.5 + i, "camera_optical", format,
                                             start + png_of(depths())));
      bag.add("/colour/image/compressed", kCompressedImage,
              test::compressed_image_message(10.5 + i, "camera_optical",
                                             "rgb8; jpeg compressed bgr8", "\xFF\xD8"));
    }
    expect_map(recording(bag), [](int) { return scan_of_depths(); });
  }
}

/// a = q (q + 1) with q = 100, and b such that 10 m are 1: as the transport chooses them.
TEST_F(BagRecordingTest, ReadsCompressedMetres) {
  const std::vector<std::uint16_t> numbers{9091, 7071, 4041, 0, 3031, 1516,
                                           1011, 9091, 1,    0, 4041, 1516};
  const std::vector<float> depths_m{1.0F, 1.25F, 2.0F,  0.0F, 2.5F, 4.0F,
                                    5.0F, 1.0F,  10.0F, 0.0F, 2.0F, 4.0F};
  test::MadeBag bag = drive();
  bag.add("/depth/camera_info", kCameraInfo, camera_info());
  for (int i = 0; i < kFrames; ++i) {
    bag.add("/depth/image/compressedDepth", kCompressedImage,
            test::compressed_image_message(10.5 + i, "camera_optical", "32FC1; compressedDepth png",
                                           quantisation(10100.0F, -1009.0F) + png_of(numbers)));
  }
  Scan expected;
  for (int i = 0; i < 12; ++i) {
    const double depth_m = depths_m[static_cast<std::size_t>(i)];
    const Eigen::Vector3d direction((i % 4 - 1.5) / 5.0, (i / 4 - 1.0) / 5.0, 1.0);
    if (depth_m > 0.0) expected.points_m.emplace_back((direction * depth_m).cast<float>());
  }
  expect_map(recording(bag), [&](int) { return expected; });
}

TEST_F(BagRecordingTest, LeavesOutAnImageThatIsWrong) {
  const auto refused = [this](const std::string& format, const std::string& data) {
    test::MadeBag bag = drive();
    bag.add("/depth/camera_info", kCameraInfo, camera_info());
    bag.add("/depth/image/compressedDepth", kCompressedImage,
            test::compressed_image_message(10.5, "camera_optical", format, data));
    return test::message_of<InputError>([&] { recording(bag)->read(0); });
  };
  const std::string header = quantisation(10100.0F, -1009.0F);
  const std::string png = png_of(depths());
  EXPECT_EQ(refused("32FC1; compressedDepth", header + png), "");
  EXPECT_THAT(refused("16UC1; compressedDepth rvl", header + "\4\0\0\0\3\0\0\0"),
              AllOf(HasSubstr("/compressedDepth at 10.5 s"), HasSubstr("compressedDepth rvl"),
                    HasSubstr("format to png")));
  EXPECT_THAT(refused("16UC1; compressedDepth", "short"), HasSubstr("holds no PNG"));
  EXPECT_THAT(refused("32FC1; compressedDepth", png), HasSubstr("holds no PNG"));
  EXPECT_THAT(refused("32FC1; compressedDepth", quantisation(test::kNaN, 0.0F) + png),
              HasSubstr("how 16-bit numbers become metres"));
  EXPECT_THAT(refused("16UC1; compressedDepth", header + png.substr(0, png.size() - 20)),
              HasSubstr("truncated"));
  EXPECT_THAT(refused("16UC1; compressedDepth", header + png.substr(0, 20)),
              HasSubstr("the PNG cannot be read"));

  test::MadeBag half = drive();
  half.add("/depth/camera_info", kCameraInfo, camera_info());
  half.add("/depth/image", kImage,
           test::image_message(10.5, "camera_optical", 2, 1, "16UC1", std::string(4, 'x')));
  EXPECT_THAT(test::message_of<InputError>([&] { recording(half)->read(0); }),
              HasSubstr("an image has 2 x 1 pixels, its camera_info is of 4 x 3 pixels"));
}

TEST_F(BagRecordingTest, SaysWhatIsMissing) {
  EXPECT_THAT(refusal(drive()), HasSubstr("no topic of sensor_msgs/PointCloud2"));
  test::MadeBag colours = drive();
  colours.add("/colour", kImage, test::image_message(10.5, "c", 1, 1, "rgb8", "abc"));
  EXPECT_THAT(refusal(colours), HasSubstr("'rgb8'"));

  test::MadeBag two = drive();
  two.add("/a", kCloud, test::cloud_message(10.5, "camera_optical", wall(0)));
  two.add("/b", kCloud, test::cloud_message(10.5, "camera_optical", wall(0)));
  EXPECT_THAT(refusal(two), AllOf(HasSubstr("several"), HasSubstr("/a ("), HasSubstr("/b (")));
  EXPECT_THAT(refusal(two, {.topic = "/c"}), AllOf(HasSubstr("'/c'"), HasSubstr("/b (")));
  EXPECT_EQ(refusal(two, {.topic = "/b"}), "");
  EXPECT_THAT(refusal(two, {.topic = "/b", .fixed_frame = "map"}),
              AllOf(HasSubstr("'camera_optical' to 'map'"), HasSubstr("odom")));

  test::MadeBag late = drive();
  late.add("/a", kCloud, test::cloud_message(20.0, "camera_optical", wall(0)));
  EXPECT_THAT(refusal(late), HasSubstr("none of the 1 frames"));
  test::MadeBag alone;
  alone.add("/a", kCloud, test::cloud_message(20.0, "camera_optical", wall(0)));
  EXPECT_THAT(refusal(alone), HasSubstr("no tf"));

  test::MadeBag unknown = drive();
  unknown.add("/depth/image", kImage,
              test::image_message(10.5, "camera_optical", 4, 3, "16UC1", std::string(24, 'x')));
  EXPECT_THAT(refusal(unknown), HasSubstr("no camera_info on '/depth/camera_info'"));
  EXPECT_EQ(refusal(unknown, {.fx_fy_cx_cy_px = {{5.0, 5.0, 1.5, 1.0}}}), "");
}

/// A frame that is wrong in itself is left out by the builder, which says why.
TEST_F(BagRecordingTest, LeavesOutAFrameThatIsWrong) {
  test::MadeBag bag = drive();
  std::string cloud = test::cloud_message(10.5, "camera_optical", wall(0));
  cloud[cloud.find('\x07', 12 + 4 + 14)] = '\x0B';  // the datatype of x
  bag.add("/points", kCloud, cloud);
  const auto found = recording(bag);
  EXPECT_THAT(test::message_of<InputError>([&] { found->read(0); }),
              AllOf(HasSubstr("/points at 10.5 s"), HasSubstr("datatype 11")));
}

TEST_F(BagRecordingTest, NoChangedByteCrashes) {
  test::MadeBag bag = drive();
  bag.add("/points", kCloud, test::cloud_message(10.5, "camera_optical", wall(0)));
  const std::string whole = bag.file();
  std::uint64_t random = 3;
  for (int i = 0; i < 200; ++i) {
    random = random * 6364136223846793005U + 1442695040888963407U;
    std::string bytes = whole;
    bytes[(random >> 33) % bytes.size()] = static_cast<char>(random >> 56);
    const std::string path = folder.write("changed.bag", bytes);
    test::message_of<InputError>([&] {
      BagRecording changed(path, {});
      for (std::uint64_t f = 0; f < changed.frames(); ++f) changed.read(f);
    });
  }
}

}  // namespace
}  // namespace nbvopt
