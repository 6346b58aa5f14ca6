#include "nbvopt/map/scan_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "map/lzf.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Rgb = std::array<std::uint8_t, 3>;
using test::TemporaryFolder;

/// The bytes of a number, in this order.
template <class Number>
std::string bytes(Number number, std::endian order = std::endian::little) {
  auto array = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (order != std::endian::native) std::ranges::reverse(array);
  return {array.data(), array.size()};
}

using Reader = Scan (*)(std::istream&, const std::string&);

Scan read(Reader reader, const std::string& content) {
  std::istringstream in(content);
  return reader(in, "some file");
}

/// One line that names the file.
std::string refusal(Reader reader, const std::string& content) {
  const std::string message = test::message_of<InputError>([&] { read(reader, content); });
  EXPECT_THAT(message, StartsWith("some file: ")) << "no refusal of: " << content.substr(0, 200);
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

/// Every prefix of the content is refused.
void expect_truncations_refused(Reader reader, const std::string& content) {
  for (std::size_t size = 0; size < content.size(); ++size) {
    refusal(reader, content.substr(0, size));
  }
}

const std::string kPlyHeader =
    "element vertex 2\n"
    "property float x\nproperty double y\nproperty float z\nproperty short intensity\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string binary_ply(std::endian order) {
  const bool is_little = order == std::endian::little;
  std::string ply = std::string("ply\nformat ") +
                    (is_little ? "binary_little_endian" : "binary_big_endian") +
                    " 1.0\ncomment made by hand\n" + kPlyHeader;
  for (const float x : {1.5F, -2.0F}) {
    ply += bytes(x, order) + bytes(0.25, order) + bytes(3.0F, order) +
           bytes(std::int16_t{-7}, order) + "\x01\x80\xff";
  }
  return ply;
}

void expect_two_points(const Scan& scan) {
  EXPECT_THAT(scan.points_m,
              ElementsAre(Eigen::Vector3f(1.5F, 0.25F, 3.0F), Eigen::Vector3f(-2.0F, 0.25F, 3.0F)));
  EXPECT_THAT(scan.colours, ElementsAre(Rgb{1, 128, 255}, Rgb{1, 128, 255}));
  EXPECT_TRUE(scan.no_returns.empty());
}

TEST(ReadPly, ReadsAscii) {
  expect_two_points(read(read_ply, "ply\nformat ascii 1.0\n" + kPlyHeader +
                                       "1.5 0.25 3 -7 1 128 255\n -2e0\t.25 3.0 -7 1 128 255\r\n"
                                       "3 0 1 1\n"));
}

TEST(ReadPly, NeedsNoLineEndAtTheFilesEnd) {
  EXPECT_THAT(read(read_ply,
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                   "property float y\nproperty float z\nend_header\n1 2 3.5")
                  .points_m,
              ElementsAre(Eigen::Vector3f(1, 2, 3.5F)));
}

TEST(ReadPly, ReadsBinaryOfBothByteOrders) {
  expect_two_points(read(read_ply, binary_ply(std::endian::little)));
  expect_two_points(read(read_ply, binary_ply(std::endian::big)));
}

TEST(ReadPly, ReadsPointsWithoutColour) {
  const Scan scan = read(read_ply,
                         "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty float z\r\n"
                         "property float x\r\nproperty float y\r\nend_header\r\n1 2 3\r\n");
  EXPECT_THAT(scan.points_m, ElementsAre(Eigen::Vector3f(2, 3, 1)));
  EXPECT_TRUE(scan.colours.empty());
}

TEST(ReadPly, SkipsWhatStandsBeforeTheVertices) {
  const std::string header =
      " 1.0\nelement camera 2\nproperty list uchar float values\nproperty int id\n"
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string list = "\x02" + bytes(1.0F) + bytes(2.0F) + bytes(std::int32_t{5});
  const std::string point = bytes(1.0F) + bytes(2.0F) + bytes(3.0F);
  for (const std::string& ply :
       {"ply\nformat binary_little_endian" + header + list + list + point,
        "ply\nformat ascii" + header + "2 1.0 2.0 5\n2 1.0 2.0 5\n1 2 3\n"}) {
    EXPECT_THAT(read(read_ply, ply).points_m, ElementsAre(Eigen::Vector3f(1, 2, 3)));
  }
}

TEST(ReadPly, KeepsPointsThatAreNotFinite) {
  const Scan scan = read(read_ply,
                         "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                         "property float y\nproperty float z\nend_header\nnan 0 1\n0 0 -inf\n");
  ASSERT_EQ(scan.points_m.size(), 2U);
  EXPECT_TRUE(std::isnan(scan.points_m[0].x()));
  EXPECT_EQ(scan.points_m[1].z(), -std::numeric_limits<float>::infinity());
}

TEST(ReadPly, RefusesWhatIsDamaged) {
  expect_truncations_refused(read_ply, binary_ply(std::endian::little));
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  refusal(read_ply, "plyx\n");
  refusal(read_ply, "ply\nelement vertex 1\n" + xyz + "1 2 3\n");
  refusal(read_ply, "ply\nformat utf8 1.0\nelement vertex 1\n" + xyz + "1 2 3\n");
  refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex many\n" + xyz);
  refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex -1\n" + xyz);
  refusal(read_ply, "ply\nformat ascii 1.0\n" + xyz);
  refusal(read_ply, "ply\nformat ascii 1.0\nelement face 1\n" + xyz + "1 2 3\n");
  refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n" + xyz);
  refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int l\n" + xyz);
  EXPECT_THAT(refusal(read_ply,
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                      "property float y\nend_header\n1 2\n"),
              HasSubstr("'z'"));
  EXPECT_THAT(refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "1 2\n"),
              HasSubstr("too few"));
  EXPECT_THAT(refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "1 2 3m\n"),
              HasSubstr("3m"));
  // A huge count must not be believed.
  refusal(read_ply,
          "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\n" + xyz + "1 2 3\n");
}

std::string pcd_header(const std::string& data, const std::string& points = "2") {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z normal rgb\n"
         "SIZE 4 8 4 2 4\nTYPE F F F I F\nCOUNT 1 1 1 3 1\nWIDTH 2\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
         points + "\nDATA " + data + "\n";
}

std::string binary_pcd() {
  std::string pcd = pcd_header("binary");
  for (const float x : {1.5F, -2.0F}) {
    pcd += bytes(x) + bytes(0.25) + bytes(3.0F) + std::string(6, 'n') +
           bytes(std::uint32_t{0xFF0180FF});
  }
  return pcd;
}

/// The columns one after the other, as LZF that copies nothing but the constant ones.
std::string compressed_pcd() {
  const std::string columns = bytes(1.5F) + bytes(-2.0F) + bytes(0.25) + bytes(0.25) + bytes(3.0F) +
                              bytes(3.0F) + std::string(12, 'n') +
                              bytes(std::uint32_t{0xFF0180FF}) + bytes(std::uint32_t{0xFF0180FF});
  std::string compressed;
  for (std::size_t i = 0; i < columns.size(); i += 32) {
    const std::string part = columns.substr(i, 32);
    compressed += static_cast<char>(part.size() - 1) + part;
  }
  return pcd_header("binary_compressed") + bytes(static_cast<std::uint32_t>(compressed.size())) +
         bytes(static_cast<std::uint32_t>(columns.size())) + compressed;
}

TEST(ReadPcd, ReadsAscii) {
  constexpr const char* kColour = "1.38110575e-40";  // of the bits 0x000180FF
  const Scan scan = read(
      read_pcd, pcd_header("ascii") + "1.5 0.25 3 1 2 3 " + kColour + "\n-2 0.25 3 1 2 3 nan\n");
  EXPECT_THAT(scan.points_m,
              ElementsAre(Eigen::Vector3f(1.5F, 0.25F, 3.0F), Eigen::Vector3f(-2.0F, 0.25F, 3.0F)));
  ASSERT_EQ(scan.colours.size(), 2U);
  EXPECT_EQ(scan.colours[0], (Rgb{1, 128, 255}));
}

TEST(ReadPcd, ReadsBinary) { expect_two_points(read(read_pcd, binary_pcd())); }

TEST(ReadPcd, ReadsBinaryCompressed) { expect_two_points(read(read_pcd, compressed_pcd())); }

TEST(ReadPcd, ReadsTheNumberOfPointsFromTheImagesSize) {
  const Scan scan = read(read_pcd,
                         "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nHEIGHT 2\nDATA ascii\n"
                         "1 2 3\n4 5 6\n");
  EXPECT_EQ(scan.points_m.size(), 2U);
  EXPECT_TRUE(scan.colours.empty());
}

TEST(ReadPcd, RefusesWhatIsDamaged) {
  expect_truncations_refused(read_pcd, binary_pcd());
  expect_truncations_refused(read_pcd, compressed_pcd());
  refusal(read_pcd, "some text\n");
  refusal(read_pcd, pcd_header("binary_zipped"));
  refusal(read_pcd, pcd_header("ascii", "-1"));
  refusal(read_pcd, pcd_header("ascii", "18446744073709551615") + "1 2 3 4 5 6 7\n");
  refusal(read_pcd, "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nDATA ascii\n1 2 3\n");
  refusal(read_pcd, "FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n");
  refusal(read_pcd, "FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n");
  refusal(read_pcd, "FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n");
  refusal(read_pcd,
          "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 0\nPOINTS 1\nDATA ascii\n1 2 3\n");
  // Sizes that do not fit together.
  std::string lying = compressed_pcd();
  const std::size_t sizes_at = pcd_header("binary_compressed").size();
  lying.replace(sizes_at + 4, 4, bytes(std::uint32_t{0xFFFFFFFF}));
  refusal(read_pcd, lying);
}

TEST(Lzf, CopiesWhatItWroteBefore) {
  const std::string compressed(
      "\x02"
      "abc"
      "\xe0\x01\x02"  // 7 + 1 + 2 bytes from 3 before
      "\x20\x00",     // 1 + 2 bytes from 1 before
      9);
  EXPECT_EQ(lzf_decompressed(compressed, 16), "abcabcabcabcaaaa");
  EXPECT_EQ(lzf_decompressed(compressed, 15), std::nullopt);
  EXPECT_EQ(lzf_decompressed(compressed, 17), std::nullopt);
  EXPECT_EQ(lzf_decompressed(compressed.substr(0, 3), 16), std::nullopt);
  EXPECT_EQ(lzf_decompressed(std::string("\x00"
                                         "a"
                                         "\x20\x01",
                                         4),
                             4),
            std::nullopt)
      << "a copy from before the start";
}

/// A grey PNG of 16 bits a pixel.
std::string png(int width, const std::vector<std::uint16_t>& pixels,
                int colour_type = PNG_COLOR_TYPE_GRAY, int bits = 16) {
  std::string file;
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_set_write_fn(
      writer, &file,
      [](png_structp p, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      nullptr);
  const int height = static_cast<int>(pixels.size()) / width;
  png_set_IHDR(writer, info, width, height, bits, colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer, info);
  for (int v = 0; v < height; ++v) {
    std::vector<png_byte> row(8 * width);
    for (int u = 0; u < width; ++u) {
      row[2 * u] = static_cast<png_byte>(pixels[v * width + u] >> 8);
      row[2 * u + 1] = static_cast<png_byte>(pixels[v * width + u]);
    }
    png_write_row(writer, row.data());
  }
  png_write_end(writer, info);
  png_destroy_write_struct(&writer, &info);
  return file;
}

const DepthImageOptions kCamera{.fx_px = 2.0, .fy_px = 4.0, .cx_px = 1.0, .cy_px = 0.5};

Scan read_kcamera_png(std::istream& in, const std::string& name) {
  return read_depth_png(in, name, kCamera);
}

TEST(ReadDepthPng, TurnsPixelsIntoPointsAndDirections) {
  const Scan scan = read(read_kcamera_png, png(3, {2000, 0, 65535,  //
                                                   1, 65534, 0}));
  EXPECT_THAT(scan.points_m, ElementsAre(Eigen::Vector3f(-1.0F, -0.25F, 2.0F),
                                         Eigen::Vector3f(-0.0005F, 0.000125F, 0.001F),
                                         Eigen::Vector3f(0.0F, 65.534F / 8.0F, 65.534F)));
  EXPECT_THAT(scan.no_returns, ElementsAre(Eigen::Vector3f(0.5F, -0.125F, 1.0F)));
  EXPECT_TRUE(scan.colours.empty());
}

TEST(ReadDepthPng, ScalesDepths) {
  DepthImageOptions camera = kCamera;
  camera.depth_scale_m = 0.0002;
  std::istringstream in(png(1, {5000}));
  EXPECT_EQ(read_depth_png(in, "some file", camera).points_m.at(0).z(), 1.0F);
}

TEST(ReadDepthPng, RefusesWhatIsDamagedOrNoDepthImage) {
  expect_truncations_refused(read_kcamera_png, png(3, {1, 2, 3, 4, 5, 6}).substr(0, 60));
  EXPECT_THAT(refusal(read_kcamera_png, png(2, {1, 2}, PNG_COLOR_TYPE_GRAY, 8)),
              HasSubstr("16 bits"));
  EXPECT_THAT(refusal(read_kcamera_png, png(2, {1, 2}, PNG_COLOR_TYPE_RGB, 8)),
              HasSubstr("16 bits"));
  std::string damaged = png(3, {1, 2, 3, 4, 5, 6});
  damaged[45] = static_cast<char>(damaged[45] ^ 0x55);
  refusal(read_kcamera_png, damaged);
}

TEST(ReadDepthPng, ChecksTheIntrinsics) {
  const auto message = [](const DepthImageOptions& options) {
    return test::message_of<InputError>([&] { options.validate(); });
  };
  EXPECT_EQ(message(kCamera), "");
  EXPECT_THAT(message(DepthImageOptions{}), HasSubstr("fx_px"));
  DepthImageOptions camera = kCamera;
  camera.fy_px = 0.0;
  EXPECT_THAT(message(camera), HasSubstr("fy_px is 0"));
  camera = kCamera;
  camera.cx_px = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message(camera), HasSubstr("cx_px"));
  camera = kCamera;
  camera.depth_scale_m = -0.001;
  EXPECT_THAT(message(camera), HasSubstr("depth_scale_m is -0.001"));
}

TEST(ReadScan, KnowsAFormatByItsContent) {
  const TemporaryFolder folder;
  expect_two_points(read_scan(folder.write("scan", binary_ply(std::endian::little))));
  expect_two_points(read_scan(folder.write("scan.ply", binary_pcd())));
  const std::string image = folder.write("scan.pcd", png(1, {1000}));
  EXPECT_EQ(read_scan(image, kCamera).points_m.size(), 1U);
  EXPECT_THAT(test::message_of<InputError>([&] { read_scan(image); }), HasSubstr("intrinsics"));
}

TEST(ReadScan, RefusesGarbage) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string content(1 + random() % 300, '\0');
    for (char& byte : content) byte = static_cast<char>(random());
    if (i % 3 == 0) content = "ply\n" + content;
    if (i % 3 == 1) content = png(1, {1}).substr(0, 8) + content;
    const std::string path = folder.write("scan", content);
    EXPECT_THAT(test::message_of<InputError>([&] { read_scan(path, kCamera); }),
                StartsWith(path + ": "));
  }
  EXPECT_THAT(test::message_of<InputError>([&] { read_scan(folder / "none.ply"); }),
              HasSubstr("none.ply"));
}

}  // namespace
}  // namespace nbvopt
