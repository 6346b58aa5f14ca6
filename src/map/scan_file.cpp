#include "nbvopt/map/scan_file.hpp"

#include <fstream>
#include <string_view>

#include "core/input_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

Scan read_scan(const std::filesystem::path& path,
               const std::optional<DepthImageOptions>& depth_image) {
  std::ifstream in = open_input_file(path);
  const std::string name = path.string();
  switch (in.peek()) {  // the first character tells the formats apart
    case 'p':
      return read_ply(in, name);
    case 0x89:
      if (!depth_image) throw InputError(name + ": a depth image needs the camera's intrinsics");
      return read_depth_png(in, name, *depth_image);
    default:
      return read_pcd(in, name);
  }
}

}  // namespace nbvopt
