// The pixels of depth images packed as PNG.
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <span>
#include <string>

namespace nbvopt {

/// Calls visit(row's number, its 16-bit pixels) from the top; memory follows what the stream holds,
/// not what it says. Throws InputError, with `name`, where it is damaged, or no PNG of 16 bits of
/// grey a pixel.
using VisitDepthRow = std::function<void(std::uint32_t row, std::span<const std::uint16_t> pixels)>;
void for_each_png_row(std::istream& in, const std::string& name, const VisitDepthRow& visit);

}  // namespace nbvopt
