#include "map/map_format_names.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

std::string to_string(MapFormat format) { return std::string(enum_name(format)); }

MapFormat map_format(const std::string& name, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (name.empty() && (extension.empty() || extension == ".ot")) return MapFormat::uncertainty_ot;
  const auto format = enum_value<MapFormat>(name.empty() ? extension.substr(1) : name);
  if (format) return *format;
  if (!name.empty()) {
    throw UsageError("map format '" + name +
                     "' is not known, it must be uncertainty-ot, bt, colour-ot, ply or pcd");
  }
  throw UsageError(path.string() +
                   ": the extension tells no format, end it in .ot, .bt, .ply or .pcd, " +
                   "or name a format");
}

}  // namespace nbvopt
