// What other programs write and read as PLY, PCD, XYZ and PGM, each variant with three points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const DepthImageOptions kVariantCamera{.fx_px = 2.0, .fy_px = 4.0, .cx_px = 1.0, .cy_px = 0.5};

Scan read_variant(const std::string& content) {
  std::istringstream in(content);
  return read_scan(in, "a file", kVariantCamera);
}

std::string refused_variant(const std::string& content) {
  return test::message_of<InputError>([&] { read_variant(content); });
}

void expect_three_points(const std::string& content) {
  Scan scan;
  EXPECT_EQ(test::message_of<InputError>([&] { scan = read_variant(content); }), "");
  EXPECT_THAT(scan.points_m, ElementsAre(Eigen::Vector3f(1, 0, 2), Eigen::Vector3f(0.5F, 0, 2),
                                         Eigen::Vector3f(-1, 0, 2)))
      << content;
}

template <class Number>
std::string little(Number number) {
  const auto array = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  return {array.data(), array.size()};
}

const std::string kPcdBody = "1 0 2\n0.5 0 2\n-1 0 2\n";

TEST(PcdVariants, OfHeaders) {
  const std::string types = "SIZE 4 4 4\nTYPE F F F\n";
  const std::string start = "FIELDS x y z\n" + types;
  for (const std::string& header : {
           "COLUMNS x y z\n" + types + "WIDTH 3\nHEIGHT 1\nPOINTS 3\n",
           "# .PCD v.5 - Point Cloud Data\nVERSION .5\nFIELDS x y z\nPOINTS 3\n" + std::string(),
           "\xEF\xBB\xBF# .PCD v0.7\r\nVERSION 0.7\r\n" + start + "POINTS 3\n",
           "\n" + start + "\n# between\n\nWIDTH 3\n" + std::string(),
           start + "WIDTH 3\nHEIGHT 1\nVIEWPOINT\nPOINTS 3\n",
           start + "WIDTH 1\nHEIGHT 1\nPOINTS 3\n",
           start + "WIDTH 3\n",
           "FIELDS X Y Z\nsize 4 4 4\ntype f f f\nCOUNT 1 1 1\nPOINTS 3\n" + std::string(),
           "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nPOINTS 3\n" + std::string(),
       }) {
    expect_three_points(header + "DATA ascii\n" + kPcdBody);
    expect_three_points(header + "DATA ASCII\r\n" + "1 0 2\r\n0.5 0 2\r\n-1 0 2");
  }
  expect_three_points(start + "POINTS 3\nDATA ascii\n1 0 2\n\n# a remark\n0.5 0 2 \n  \n-1 0 2\n");
}

TEST(PcdVariants, OfBinaryNumbers) {
  const std::string header =
      "VERSION 0.7\nFIELDS label x y z _\nSIZE 8 8 2 4 1\nTYPE U F I F U\nCOUNT 1 1 1 1 3\n"
      "WIDTH 3\nHEIGHT 1\nDATA binary\n";
  std::string body;
  for (const double x : {1.0, 0.5, -1.0}) {
    body += little(std::uint64_t{7}) + little(x) + little(std::int16_t{0}) + little(2.0F) + "abc";
  }
  expect_three_points(header + body);
  expect_three_points(header + body + "\n");
  EXPECT_THAT(refused_variant(header + body.substr(0, body.size() - 1)),
              HasSubstr("after 2 of 3 points"));
}

TEST(PcdVariants, OfWhatIsNotFinite) {
  const Scan scan = read_variant(
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 4\nDATA ascii\nNaN -nan NAN\n1.#QNAN -1.#IND "
      "1.#INF\n"
      "inf -Infinity +1e1\n-1.#INF000 nan(ind) 0\n");
  ASSERT_EQ(scan.points_m.size(), 4U);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(scan.points_m[0].array().isNaN().all());
  EXPECT_TRUE(scan.points_m[1].head<2>().array().isNaN().all());
  EXPECT_EQ(scan.points_m[1].z(), infinity);
  EXPECT_EQ(scan.points_m[2], Eigen::Vector3f(infinity, -infinity, 10));
  EXPECT_EQ(scan.points_m[3].x(), -infinity);
}

TEST(PcdVariants, AreRefusedWithTheLine) {
  const std::string start = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  EXPECT_THAT(refused_variant(start + "POINTS 2\nDATA ascii\n1 2 3\n\n1 2\n"),
              HasSubstr("a file: line 8: too few numbers"));
  EXPECT_THAT(refused_variant(start + "POINTS 2\nDATA ascii\n1 2 x\n"),
              HasSubstr("line 6: 'x' stands where a number"));
  EXPECT_THAT(refused_variant(start + "POINTS two\n"), HasSubstr("line 4"));
  EXPECT_THAT(refused_variant(start + "PIONTS 2\n"), HasSubstr("line 4: 'PIONTS 2'"));
  EXPECT_THAT(refused_variant(start + "POINTS 2\nDATA ascii\n1 2 3\n"),
              HasSubstr("after 1 of 2 points"));
  EXPECT_THAT(refused_variant(start + "POINTS 2\n"), HasSubstr("within its header"));
  EXPECT_THAT(refused_variant("FIELDS x y z\nDATA binary\n"),
              HasSubstr("neither POINTS nor WIDTH"));
}

TEST(PcdVariants, OfTheViewpoint) {
  const auto viewpoint = [](const std::string& line) {
    std::istringstream in("FIELDS x y z\n" + line + "POINTS 0\nDATA ascii\n");
    return read_pcd_viewpoint(in, "a file");
  };
  const auto T = viewpoint("VIEWPOINT 1 2 3 0 0 0 2\n");  // half a turn about z, w first
  ASSERT_TRUE(T);
  EXPECT_TRUE((*T * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, 2, 3)));
  EXPECT_FALSE(viewpoint(""));
  EXPECT_FALSE(viewpoint("VIEWPOINT 0 0 0 0 0 0 0\n"));
  EXPECT_FALSE(viewpoint("VIEWPOINT 1 2\n"));
}

const std::string kPlyXyz = "property float x\nproperty float y\nproperty float z\n";

TEST(PlyVariants, OfHeaders) {
  for (const std::string& start : {
           std::string("ply\nformat ascii 1.0\n"),
           std::string("\xEF\xBB\xBFply\r\nformat ascii 1.0\r\ncomment Windows\r\n"),
           std::string("ply \ncomment before the format\nformat ascii 1.0\n\nobj_info scanned\n"),
           std::string("ply\nformat ascii 1.0\nelement camera 1\nproperty float view\n"),
       }) {
    const std::string before = start.ends_with("view\n") ? "7\n" : "";
    for (const std::string& vertex : {
             "element vertex 3\n" + kPlyXyz,
             std::string("element vertex 3\ncomment here\nproperty Float32 X\nproperty double Y\n"
                         "property float64 Z\n"),
         }) {
      for (const std::string& rest : {std::string(), std::string("element face 1\nproperty list "
                                                                 "uchar int vertex_indices\n")}) {
        const std::string after = rest.empty() ? "" : "3 0 1 2\n";
        expect_three_points(start + vertex + rest + "comment last\nend_header\n" + before +
                            kPcdBody + after);
        expect_three_points(start + vertex + rest + "end_header\r\n" + before +
                            "1 0 2 \r\n\r\n 0.5 0 2\t\r\n-1 0 2");
      }
    }
  }
}

TEST(PlyVariants, OfPropertiesThatNobodyKnows) {
  const std::string header =
      " 1.0\nelement vertex 3\nproperty list uchar short tracks\nproperty int64 id\n"
      "property float x\nproperty float y\nproperty list uint double weights\nproperty float z\n"
      "property uint64 stamp\nend_header\n";
  const std::string ascii = "2 7 8 -5 1 0 0 2 9\n0 -5 0.5 0 1 0.25 2 9\n1 7 -5 -1 0 0 2 9\n";
  expect_three_points("ply\nformat ascii" + header + ascii);
  std::string body;
  for (const float x : {1.0F, 0.5F, -1.0F}) {
    body += "\x01" + little(std::int16_t{7}) + little(std::int64_t{-5}) + little(x) + little(0.0F) +
            little(std::uint32_t{2}) + little(1.0) + little(2.0) + little(2.0F) +
            little(std::uint64_t{9});
  }
  expect_three_points("ply\nformat binary_little_endian" + header + body);
  EXPECT_THAT(refused_variant("ply\nformat binary_little_endian" + header + body.substr(0, 60)),
              HasSubstr("after 1 of 3 points"));
}

TEST(PlyVariants, AreRefusedWithTheLine) {
  const std::string start = "ply\nformat ascii 1.0\n";
  EXPECT_THAT(refused_variant(start + "element vertex 2\n" + kPlyXyz + "end_header\n1 2 3\n1 2\n"),
              HasSubstr("a file: line 9: too few numbers"));
  EXPECT_THAT(refused_variant(start + "element vertex two\n"), HasSubstr("line 3: 'element"));
  EXPECT_THAT(refused_variant(start + "elements vertex 2\n"), HasSubstr("line 3"));
  EXPECT_THAT(refused_variant(start + "element vertex 2\n" + kPlyXyz + "end_header\n1 2 3\n"),
              HasSubstr("after 1 of 2 points"));
  EXPECT_THAT(refused_variant(start + "element vertex 1\n" + kPlyXyz), HasSubstr("its header"));
}

TEST(XyzFiles, OfAllSeparators) {
  for (const std::string content : {
           "1 0 2\n0.5 0 2\n-1 0 2\n",
           "1,0,2,255\n0.5,0,2,255\n-1,0,2,255",
           "1; 0; 2\r\n0.5; 0; 2\r\n-1; 0; 2\r\n",
           "# a remark\n//X Y Z\n+1\t0\t2\n\n.5\t0\t2\n-1e0\t0\t2\n",
           "x y z\n1 0 2\n0.5 0 2\n-1 0 2\n",
           "time,Y,X,Z\n8,0,1,2\n9,0,0.5,2\n9,0,-1,2\n",
           "3\n1 0 2 99\n0.5 0 2 99\n-1 0 2 99\n",
       }) {
    expect_three_points(content);
  }
  EXPECT_THAT(refused_variant("1 0 2\n1 0\n"), HasSubstr("line 2: too few"));
  EXPECT_THAT(refused_variant("1 0 2\n1 0 z\n"), HasSubstr("line 2: 'z'"));
  EXPECT_THAT(refused_variant("some text\n"), HasSubstr("line 1"));
}

TEST(PgmFiles, OfBothKinds) {
  const std::string bytes("\x03\xE8\x00\x00\xFF\xFF\x00\x01", 8);
  for (const std::string& content :
       {"P5\n2 2\n65535\n" + bytes, "P5 # a camera\n# 2x2\n2 2 65535 " + bytes,
        std::string("P2\n2 2\n65535\n1000 0\n65535 1\n")}) {
    const Scan scan = read_variant(content);
    EXPECT_THAT(scan.points_m, ElementsAre(Eigen::Vector3f(-0.5F, -0.125F, 1.0F),
                                           Eigen::Vector3f(0.0F, 0.000125F, 0.001F)));
    EXPECT_THAT(scan.no_returns, ElementsAre(Eigen::Vector3f(-0.5F, 0.125F, 1.0F)));
  }
  EXPECT_THAT(refused_variant("P5\n2 2\n255\nabcd"), HasSubstr("16 bits"));
  EXPECT_THAT(refused_variant("P5\n2 2\n65535\nabc"), HasSubstr("truncated"));
  EXPECT_THAT(refused_variant("P5\n2 many\n65535\nabc"), HasSubstr("height is 'many'"));
  EXPECT_THAT(refused_variant("P2\n2 2\n65535\n1 2 3"), HasSubstr("truncated"));
  EXPECT_THAT(refused_variant("P2\n1 1\n65535\n70000"), HasSubstr("pixel is '70000'"));
}

TEST(DepthImages, OfTheLargestValue) {
  const auto scan_with = [](LargestValue meaning) {
    DepthImageOptions camera = kVariantCamera;
    camera.largest_value = meaning;
    std::istringstream in("P2\n1 1\n65535\n65535\n");
    return read_depth_pgm(in, "a file", camera);
  };
  EXPECT_EQ(scan_with(LargestValue::no_return).no_returns.size(), 1U);
  EXPECT_TRUE(scan_with(LargestValue::no_return).points_m.empty());
  EXPECT_TRUE(scan_with(LargestValue::invalid).no_returns.empty());
  EXPECT_TRUE(scan_with(LargestValue::invalid).points_m.empty());
  EXPECT_TRUE(scan_with(LargestValue::far).no_returns.empty());
  EXPECT_EQ(scan_with(LargestValue::far).points_m.at(0).z(), 65.535F);
}

TEST(DepthImages, OfACameraWhoseRowsRunUpwards) {
  DepthImageOptions camera = kVariantCamera;
  camera.fy_px = -4.0;
  std::istringstream in("P2\n1 2\n65535\n2000 2000\n");
  EXPECT_THAT(read_depth_pgm(in, "a file", camera).points_m,
              ElementsAre(Eigen::Vector3f(-1, 0.25F, 2), Eigen::Vector3f(-1, -0.25F, 2)));
  camera.fy_px = 0.0;
  EXPECT_THAT(test::message_of<InputError>([&] { camera.validate(); }), HasSubstr("fy_px is 0"));
}

}  // namespace
}  // namespace nbvopt
