#include "map/point_cloud_message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::uint8_t kFloat32 = 7;
constexpr std::uint8_t kFloat64 = 8;

/// Two rows of two points x, y, z, rgb of four bytes each, with padding after points and rows.
struct CloudMessage {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(2 * 44);
  PointCloudMessage cloud{
      .height = 2,
      .width = 2,
      .fields = {{"x", 0, kFloat32}, {"y", 4, kFloat32}, {"z", 8, kFloat32}, {"rgb", 16, kFloat32}},
      .point_step = 20,
      .row_step = 44};

  CloudMessage() {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const float first = 1.0F + static_cast<float>(i);
      for (const auto& [offset, number] : {std::pair{0U, first}, {4U, -first}, {8U, 0.5F}}) {
        put(i, offset, std::bit_cast<std::uint32_t>(number));
      }
      put(i, 16, 0x00102030U + i);
    }
    cloud.data = bytes;
  }
  void put(std::uint32_t point, std::uint32_t offset, std::uint32_t number) {
    std::memcpy(&bytes[(point / 2) * 44 + (point % 2) * 20 + offset], &number, sizeof number);
  }
};

TEST(PointCloudMessage, IsReadRowByRow) {
  const CloudMessage message;
  const Scan scan = scan_of(message.cloud);
  ASSERT_EQ(scan.points_m.size(), 4U);
  EXPECT_EQ(scan.points_m[0], Eigen::Vector3f(1.0F, -1.0F, 0.5F));
  EXPECT_EQ(scan.points_m[3], Eigen::Vector3f(4.0F, -4.0F, 0.5F));
  ASSERT_EQ(scan.colours.size(), 4U);
  EXPECT_THAT(scan.colours[3], ElementsAre(0x10, 0x20, 0x33));
}

TEST(PointCloudMessage, BytesMayBeTheOtherWayRound) {
  CloudMessage message;
  for (std::size_t i = 0; i + 4 <= message.bytes.size(); i += 4) {
    std::reverse(&message.bytes[i], &message.bytes[i] + 4);
  }
  message.cloud.is_bigendian = true;
  const Scan scan = scan_of(message.cloud);
  EXPECT_EQ(scan.points_m[3], Eigen::Vector3f(4.0F, -4.0F, 0.5F));
  EXPECT_THAT(scan.colours[0], ElementsAre(0x10, 0x20, 0x30));
}

TEST(PointCloudMessage, MayHoldNothing) {
  CloudMessage message;
  message.cloud.width = 0;
  message.cloud.data = {};
  EXPECT_TRUE(scan_of(message.cloud).points_m.empty());
}

std::string refusal(const PointCloudMessage& cloud) {
  return test::message_of<InputError>([&] { scan_of(cloud); });
}

TEST(PointCloudMessage, DataMustHoldWhatIsSaid) {
  CloudMessage message;
  message.cloud.data = message.cloud.data.first(44 + 39);  // the last point ends a byte later
  EXPECT_THAT(refusal(message.cloud), HasSubstr("83 bytes of data"));
  message = {};
  message.cloud.data = message.bytes;
  message.cloud.height = 0xFFFFFFFFU;
  EXPECT_THAT(refusal(message.cloud), HasSubstr("4294967295"));
  message.cloud.height = 2;
  message.cloud.row_step = 0;
  EXPECT_THAT(refusal(message.cloud), HasSubstr("rows of 0 bytes"));
  message.cloud.row_step = 44;
  message.cloud.width = 0xFFFFFFFFU;
  EXPECT_THAT(refusal(message.cloud), HasSubstr("88 bytes of data"));
}

TEST(PointCloudMessage, FieldsMustBeThere) {
  CloudMessage message;
  message.cloud.data = message.bytes;
  message.cloud.fields[2].name = "range";
  EXPECT_THAT(refusal(message.cloud), HasSubstr("no field 'z'"));
  message.cloud.fields[2] = {"z", 13, kFloat64};
  EXPECT_THAT(refusal(message.cloud), HasSubstr("beyond the point's 20 bytes"));
  message.cloud.fields[2] = {"z", 0xFFFFFFFFU, kFloat32};
  EXPECT_THAT(refusal(message.cloud), HasSubstr("beyond"));
  message.cloud.fields[2] = {"z", 8, 9};
  EXPECT_THAT(refusal(message.cloud), HasSubstr("datatype 9"));
}

}  // namespace
}  // namespace nbvopt
