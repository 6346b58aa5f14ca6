// Whatever bytes stand for a scan, its reader gives a scan or an InputError; colours are one a
// point, or none.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    std::istringstream in(bytes);
    const nbvopt::Scan scan = nbvopt::read_scan(
        in, "fuzz",
        nbvopt::DepthImageOptions{.fx_px = 100.0, .fy_px = -100.0, .cx_px = 4.0, .cy_px = 3.0});
    if (!scan.colours.empty() && scan.colours.size() != scan.points_m.size()) std::abort();
  } catch (const nbvopt::InputError&) {
  }
  try {
    std::istringstream in(bytes);
    const auto viewpoint = nbvopt::read_pcd_viewpoint(in, "fuzz");
    if (viewpoint && !viewpoint->matrix().allFinite()) std::abort();
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
