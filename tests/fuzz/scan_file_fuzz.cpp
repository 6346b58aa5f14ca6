// Whatever bytes stand for a scan, its reader gives a scan or an InputError; colours are one a
// point, or none.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace {

nbvopt::Scan read(std::istream& in) {
  switch (in.peek()) {
    case 'p':
      return nbvopt::read_ply(in, "fuzz");
    case 0x89:
      return nbvopt::read_depth_png(in, "fuzz",
                                    {.fx_px = 100.0, .fy_px = 100.0, .cx_px = 4.0, .cy_px = 3.0});
    default:
      return nbvopt::read_pcd(in, "fuzz");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const nbvopt::Scan scan = read(in);
    if (!scan.colours.empty() && scan.colours.size() != scan.points_m.size()) std::abort();
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
