// Numbers as a page carries them: little-endian, packed by zlib, as base 64.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "web/surface_mesh.hpp"

namespace nbvopt {

/// The bytes, packed; empty for none.
std::string packed_bytes(std::string_view bytes);

/// Numbers as they lie in memory.
template <class Number>
std::string packed_array(const std::vector<Number>& numbers) {
  return packed_bytes(
      {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

/// Four 16-bit numbers a rectangle: x, y, z of its least voxel, and width - 1 (5 bits),
/// height - 1 (5 bits) and normal (3 bits) from the lowest bit on.
std::string packed_rectangles(std::span<const FaceRectangle> rectangles);

/// All of a surface: how many rectangles each set has, as three 32-bit numbers; the rectangles as
/// above; the values of `seen` and `backs`. Empty for no surface.
std::string packed_surface(const SurfaceMesh& mesh);

/// Single-precision numbers.
std::string packed_numbers(std::span<const double> numbers);

}  // namespace nbvopt
