#include "map/point_cloud_message.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "map/point_records.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// By PointCloudField::datatype, from 1 on.
constexpr std::array kNumberTypes{NumberType::i8,  NumberType::u8,  NumberType::i16,
                                  NumberType::u16, NumberType::i32, NumberType::u32,
                                  NumberType::f32, NumberType::f64};

struct NumberInPoint {
  std::uint32_t offset;
  NumberType type;
};

const PointCloudField* find_field(const PointCloudMessage& cloud, const char* name) {
  const auto found = std::ranges::find(cloud.fields, name, &PointCloudField::name);
  return found == cloud.fields.end() ? nullptr : &*found;
}

NumberInPoint number_in_point(const PointCloudMessage& cloud, const PointCloudField& field) {
  if (field.datatype < 1 || field.datatype > kNumberTypes.size()) {
    throw InputError("the cloud's field '" + field.name + "' is of datatype " +
                     std::to_string(field.datatype) + ", which there is not");
  }
  const NumberType type = kNumberTypes[field.datatype - 1U];
  if (std::uint64_t{field.offset} + byte_size(type) > cloud.point_step) {
    throw InputError("the cloud's field '" + field.name + "' lies beyond the point's " +
                     std::to_string(cloud.point_step) + " bytes");
  }
  return {field.offset, type};
}

NumberInPoint coordinate(const PointCloudMessage& cloud, const char* name) {
  const PointCloudField* field = find_field(cloud, name);
  if (field == nullptr) {
    throw InputError("the cloud has no field '" + std::string(name) + "'");
  }
  return number_in_point(cloud, *field);
}

/// The bits of blue, green and red from the lowest on, whatever type the field claims.
std::optional<NumberInPoint> packed_colour(const PointCloudMessage& cloud) {
  const PointCloudField* field = find_field(cloud, "rgb");
  if (field == nullptr) field = find_field(cloud, "rgba");
  if (field == nullptr) return std::nullopt;
  const NumberInPoint number = number_in_point(cloud, *field);
  if (byte_size(number.type) != sizeof(std::uint32_t)) return std::nullopt;
  return NumberInPoint{number.offset, NumberType::u32};
}

void check_size(const PointCloudMessage& cloud) {
  if (cloud.height == 0 || cloud.width == 0) return;
  const std::uint64_t row_bytes = std::uint64_t{cloud.width} * cloud.point_step;
  const bool is_whole =
      cloud.point_step > 0 && cloud.row_step >= row_bytes &&
      cloud.data.size() / cloud.row_step + 1 >= cloud.height &&
      cloud.data.size() >= std::uint64_t{cloud.height - 1} * cloud.row_step + row_bytes;
  if (is_whole) return;
  throw InputError("the cloud of " + std::to_string(cloud.width) + " x " +
                   std::to_string(cloud.height) + " points of " + std::to_string(cloud.point_step) +
                   " bytes, rows of " + std::to_string(cloud.row_step) + " bytes, has " +
                   std::to_string(cloud.data.size()) + " bytes of data");
}

}  // namespace

Scan scan_of(const PointCloudMessage& cloud) {
  check_size(cloud);
  const std::array xyz{coordinate(cloud, "x"), coordinate(cloud, "y"), coordinate(cloud, "z")};
  const std::optional<NumberInPoint> colour = packed_colour(cloud);
  const std::endian order = cloud.is_bigendian ? std::endian::big : std::endian::little;
  Scan scan;
  if (cloud.width == 0) return scan;
  scan.points_m.reserve(std::size_t{cloud.height} * cloud.width);
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    const auto* point =
        reinterpret_cast<const char*>(cloud.data.data()) + std::uint64_t{row} * cloud.row_step;
    for (std::uint32_t i = 0; i < cloud.width; ++i, point += cloud.point_step) {
      const auto number = [&](const NumberInPoint& where) {
        return decoded_number(point + where.offset, where.type, order);
      };
      scan.points_m.emplace_back(
          Eigen::Vector3d(number(xyz[0]), number(xyz[1]), number(xyz[2])).cast<float>());
      if (!colour) continue;
      const auto bits = static_cast<std::uint32_t>(number(*colour));
      scan.colours.push_back({static_cast<std::uint8_t>(bits >> 16 & 0xFF),
                              static_cast<std::uint8_t>(bits >> 8 & 0xFF),
                              static_cast<std::uint8_t>(bits & 0xFF)});
    }
  }
  return scan;
}

}  // namespace nbvopt
