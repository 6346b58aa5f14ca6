#include "web/packed.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <new>

#include "core/base64.hpp"

namespace nbvopt {
namespace {

static_assert(std::endian::native == std::endian::little, "pages carry little-endian numbers");

/// As packed_rectangles() packs them.
std::vector<std::array<std::uint16_t, 4>> numbers_of(std::span<const FaceRectangle> rectangles) {
  std::vector<std::array<std::uint16_t, 4>> numbers;
  numbers.reserve(rectangles.size());
  for (const FaceRectangle& r : rectangles) {
    const int shape = (r.width - 1) | (r.height - 1) << 5 | static_cast<int>(r.normal) << 10;
    numbers.push_back({r.least.x, r.least.y, r.least.z, static_cast<std::uint16_t>(shape)});
  }
  return numbers;
}

template <class Number>
void append_bytes(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

}  // namespace

std::string packed_bytes(std::string_view bytes) {
  if (bytes.empty()) return {};
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  // It can fail for want of memory alone.
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return base64(packed);
}

std::string packed_rectangles(std::span<const FaceRectangle> rectangles) {
  return packed_array(numbers_of(rectangles));
}

std::string packed_surface(const SurfaceMesh& mesh) {
  const std::array sets{&mesh.seen, &mesh.backs, &mesh.frontier};
  if (std::ranges::all_of(sets, [](const FaceSet* set) { return set->rectangles.empty(); })) {
    return {};
  }
  std::string bytes;
  std::vector<std::uint32_t> counts;
  for (const FaceSet* set : sets)
    counts.push_back(static_cast<std::uint32_t>(set->rectangles.size()));
  append_bytes(bytes, counts);
  for (const FaceSet* set : sets) append_bytes(bytes, numbers_of(set->rectangles));
  for (const FaceSet* set : sets) append_bytes(bytes, set->values);
  return packed_bytes(bytes);
}

std::string packed_numbers(std::span<const double> numbers) {
  return packed_array(std::vector<float>(numbers.begin(), numbers.end()));
}

}  // namespace nbvopt
