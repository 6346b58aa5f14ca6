#include "protocol/map_messages.hpp"

#include <array>
#include <cstring>

#include "core/enum_names.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/depth_image.hpp"
#include "protocol/limit_error.hpp"
#include "protocol/needed_field.hpp"

namespace nbvopt {
namespace {

constexpr auto kFormats = std::to_array<EnumName<MapFormat, v1::MapFormat>>({
    {MapFormat::uncertainty_ot, v1::MAP_FORMAT_UNCERTAINTY_OT},
    {MapFormat::bt, v1::MAP_FORMAT_BT},
    {MapFormat::colour_ot, v1::MAP_FORMAT_COLOUR_OT},
    {MapFormat::colour_ply, v1::MAP_FORMAT_COLOUR_PLY},
});

constexpr std::size_t kPointBytes = 3 * sizeof(float);

void check_points(std::uint64_t points, std::uint64_t max_points) {
  if (points <= max_points) return;
  throw LimitError("the scan has " + std::to_string(points) + " points, the limit is " +
                   std::to_string(max_points) + " (max_scan_points)");
}

/// Points as a message packs them: the machine's own numbers, which are little-endian.
std::vector<Eigen::Vector3f> unpacked_points(const std::string& bytes, const char* field) {
  if (bytes.size() % kPointBytes != 0) {
    throw InputError(std::string(field) + " has " + std::to_string(bytes.size()) +
                     " bytes, not a multiple of 12: the scan is cut short");
  }
  std::vector<Eigen::Vector3f> points(bytes.size() / kPointBytes);
  if (!points.empty()) std::memcpy(points.front().data(), bytes.data(), bytes.size());
  return points;
}

std::string packed_points(const std::vector<Eigen::Vector3f>& points) {
  if (points.empty()) return {};
  return {reinterpret_cast<const char*>(points.front().data()), points.size() * kPointBytes};
}

Scan scan_of(const v1::PointCloud& cloud, std::uint64_t max_points) {
  check_points((cloud.xyz_m().size() + cloud.no_return_xyz().size()) / kPointBytes, max_points);
  Scan scan{.points_m = unpacked_points(cloud.xyz_m(), "points.xyz_m"),
            .colours = {},
            .no_returns = unpacked_points(cloud.no_return_xyz(), "points.no_return_xyz")};
  if (cloud.rgb().empty()) return scan;
  if (cloud.rgb().size() != 3 * scan.points_m.size()) {
    throw InputError("points.rgb has " + std::to_string(cloud.rgb().size()) +
                     " bytes, give 3 a point (" + std::to_string(3 * scan.points_m.size()) +
                     ") or none");
  }
  scan.colours.resize(scan.points_m.size());
  std::memcpy(scan.colours.front().data(), cloud.rgb().data(), cloud.rgb().size());
  return scan;
}

Scan scan_of(const v1::DepthImage& image, std::uint64_t max_points) {
  if (!image.has_width_px()) throw InputError("depth_image.width_px is not set");
  if (!image.has_height_px()) throw InputError("depth_image.height_px is not set");
  const std::uint64_t width = image.width_px();
  const std::uint64_t height = image.height_px();
  if (width == 0 || height == 0) throw InputError("depth_image has no pixels");
  check_points(width * height, max_points);
  if (width * height * sizeof(std::uint16_t) != image.depth().size()) {
    throw InputError("depth_image.depth has " + std::to_string(image.depth().size()) + " bytes, " +
                     std::to_string(width) + " x " + std::to_string(height) + " pixels take " +
                     std::to_string(width * height * sizeof(std::uint16_t)));
  }
  DepthImageOptions options{.fx_px = needed(image.has_fx_px(), image.fx_px(), "depth_image.fx_px"),
                            .fy_px = needed(image.has_fy_px(), image.fy_px(), "depth_image.fy_px"),
                            .cx_px = needed(image.has_cx_px(), image.cx_px(), "depth_image.cx_px"),
                            .cy_px = needed(image.has_cy_px(), image.cy_px(), "depth_image.cy_px")};
  if (image.has_depth_scale_m()) options.depth_scale_m = image.depth_scale_m();
  options.validate();
  Scan scan;
  std::vector<std::uint16_t> row(width);
  for (std::uint64_t v = 0; v < height; ++v) {
    const std::size_t row_bytes = width * sizeof(std::uint16_t);
    std::memcpy(row.data(), image.depth().data() + v * row_bytes, row_bytes);
    append_depth_row(row, static_cast<std::uint32_t>(v), options, scan);
  }
  return scan;
}

}  // namespace

MapFormat from_message(v1::MapFormat format) {
  if (format == v1::MAP_FORMAT_UNSPECIFIED) return MapFormat::uncertainty_ot;
  if (const auto own = value_in(kFormats, format)) return *own;
  throw InputError("format is " + std::to_string(format) + ", which is no map format");
}

Scan scan_from_message(const v1::InsertScanRequest& request, std::uint64_t max_points) {
  switch (request.scan_case()) {
    case v1::InsertScanRequest::kPoints:
      return scan_of(request.points(), max_points);
    case v1::InsertScanRequest::kDepthImage:
      return scan_of(request.depth_image(), max_points);
    case v1::InsertScanRequest::SCAN_NOT_SET:
      break;
  }
  throw InputError("scan is not set: give points or depth_image");
}

v1::MapFormat to_message(MapFormat format) {
  return name_in(kFormats, format).value_or(v1::MAP_FORMAT_UNSPECIFIED);
}

v1::PointCloud to_message(const Scan& scan) {
  v1::PointCloud cloud;
  cloud.set_xyz_m(packed_points(scan.points_m));
  cloud.set_no_return_xyz(packed_points(scan.no_returns));
  if (!scan.colours.empty()) {
    cloud.set_rgb(std::string(reinterpret_cast<const char*>(scan.colours.front().data()),
                              3 * scan.colours.size()));
  }
  return cloud;
}

}  // namespace nbvopt
