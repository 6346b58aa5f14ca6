// Reading scans: point clouds (PLY, PCD, XYZ text) and depth images (PNG, PGM), all in the sensor
// frame. Readers take what other programs write and read: line ends and byte order marks of
// Windows, empty lines, properties and fields that nobody knows, numbers of every type. What they
// refuse, they name with the line.
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

/// The same from a stream; `name` stands for the file in messages. Of a pipe, the first character
/// decides.
Scan read_scan(std::istream& in, const std::string& name,
               const std::optional<DepthImageOptions>& depth_image = {});

/// The vertices of a PLY file, ascii or binary: the properties x, y, z of any scalar type, and
/// red, green, blue of type uchar when all are there; all else is skipped.
Scan read_ply(std::istream& in, const std::string& name);

/// The points of a PCD file of any version, ascii, binary or binary_compressed: the fields x, y, z
/// of any type, and rgb or rgba; all else, the viewpoint too, is skipped. Without SIZE, TYPE and
/// COUNT, fields are floats; without POINTS, there are WIDTH times HEIGHT points.
Scan read_pcd(std::istream& in, const std::string& name);

/// The sensor's pose that a PCD file's VIEWPOINT tells: position and quaternion, w first. None
/// where it has none, or one that is no pose.
std::optional<Transform> read_pcd_viewpoint(std::istream& in, const std::string& name);

/// Text with a point a line, the words separated by white space, commas or semicolons: x, y, z
/// first, or where a first line of names says. '#', '//' and '%' start comments; a first line of
/// one whole number is the count of .pts files.
Scan read_xyz(std::istream& in, const std::string& name);

/// A 16-bit grey PNG of depths.
Scan read_depth_png(std::istream& in, const std::string& name, const DepthImageOptions& options);

/// A 16-bit PGM of depths, binary (high byte first) or plain.
Scan read_depth_pgm(std::istream& in, const std::string& name, const DepthImageOptions& options);

}  // namespace nbvopt
