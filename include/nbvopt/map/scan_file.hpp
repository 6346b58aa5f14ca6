// Reading scans: point clouds (PLY, PCD) and depth images (PNG), all in the sensor frame.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "nbvopt/map/depth_image.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// Reads a scan; the content decides the format, not the file's name. A depth image needs
/// `depth_image`, point clouds do not use it. Points that are not finite are kept, for insertion
/// to count and ignore. Throws InputError that names the file and what is wrong with it.
Scan read_scan(const std::filesystem::path& path,
               const std::optional<DepthImageOptions>& depth_image = {});

/// The vertices of a PLY file, ascii or binary: the properties x, y, z of any scalar type, and
/// red, green, blue of type uchar when all are there; all else is skipped. `name` stands for the
/// file in messages.
Scan read_ply(std::istream& in, const std::string& name);

/// The points of a PCD file, ascii, binary or binary_compressed: the fields x, y, z of any type,
/// and rgb or rgba; all else, the viewpoint too, is skipped.
Scan read_pcd(std::istream& in, const std::string& name);

/// A 16-bit grey PNG of depths. 0 means that the pixel is not known, as drivers have it; 65535,
/// the largest value, that nothing is in range.
Scan read_depth_png(std::istream& in, const std::string& name, const DepthImageOptions& options);

}  // namespace nbvopt
