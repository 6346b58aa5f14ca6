#include "sim/world/heightmap.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr std::uint32_t kPixelsMax = 8193;
constexpr std::size_t kSamplesMax = 1025;

/// Reads the first channel of a PNG. libpng leaves its functions by longjmp(), over which no C++
/// object may live: the functions below that call it own nothing, and what they fill are members.
class Picture {
 public:
  explicit Picture(const std::string& bytes) : rest_(bytes.data(), bytes.size()) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
    png_set_user_limits(png_, kPixelsMax, kPixelsMax);
    png_set_read_fn(png_, this, on_read);
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture() { png_destroy_read_struct(&png_, &info_, nullptr); }

  /// False when it cannot be read; message() then says why.
  bool read() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_png(png_, info_, PNG_TRANSFORM_EXPAND | PNG_TRANSFORM_STRIP_ALPHA, nullptr);
    return true;
  }

  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }

  double at(std::size_t row, std::size_t col) const {
    const bool is_deep = png_get_bit_depth(png_, info_) == 16;
    const std::size_t size_bytes = std::size_t{png_get_channels(png_, info_)} * (is_deep ? 2 : 1);
    const png_bytep pixel = png_get_rows(png_, info_)[row] + col * size_bytes;
    return is_deep ? pixel[0] * 256.0 + pixel[1] : pixel[0];  // PNG stores the high byte first
  }

  const char* message() const { return message_.data(); }

 private:
  static void on_read(png_structp png, png_bytep bytes, std::size_t count) {
    auto& self = *static_cast<Picture*>(png_get_io_ptr(png));
    if (count > self.rest_.size()) png_error(png, "it is truncated");
    std::ranges::copy(self.rest_.first(count), bytes);
    self.rest_ = self.rest_.subspan(count);
  }

  static void on_error(png_structp png, png_const_charp message) {
    auto& self = *static_cast<Picture*>(png_get_error_ptr(png));
    std::snprintf(self.message_.data(), self.message_.size(), "%s", message);
    png_longjmp(png, 1);
  }

  static void on_warning(png_structp, png_const_charp) {}

  std::span<const char> rest_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::array<char, 128> message_{};
};

/// Which pixels of a side are taken: all, or as many as are allowed, evenly, both ends among them.
std::vector<std::size_t> samples_of(std::size_t pixels) {
  const std::size_t count = std::min(pixels, kSamplesMax);
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < count; ++i) samples.push_back(i * (pixels - 1) / (count - 1));
  return samples;
}

double brightest(const Picture& picture) {
  double most = 0.0;
  for (std::size_t row = 0; row < picture.height(); ++row) {
    for (std::size_t col = 0; col < picture.width(); ++col) {
      most = std::max(most, picture.at(row, col));
    }
  }
  return most;
}

TriangleMesh terrain_of(const Picture& picture, const Eigen::Vector3d& size_m) {
  const std::vector<std::size_t> rows = samples_of(picture.height());
  const std::vector<std::size_t> cols = samples_of(picture.width());
  const double most = brightest(picture);
  const double z_m_a_unit = most > 0.0 ? std::abs(size_m.z()) / most : 0.0;
  TriangleMesh mesh;
  mesh.vertices_m.reserve(rows.size() * cols.size());
  for (const std::size_t row : rows) {
    for (const std::size_t col : cols) {
      const double right = static_cast<double>(col) / static_cast<double>(picture.width() - 1);
      const double down = static_cast<double>(row) / static_cast<double>(picture.height() - 1);
      const double z_m = z_m_a_unit * picture.at(row, col);
      mesh.vertices_m.push_back(Eigen::Vector3d(size_m.x() * (right - 0.5),
                                                size_m.y() * (0.5 - down),
                                                size_m.z() < 0.0 ? std::abs(size_m.z()) - z_m : z_m)
                                    .cast<float>());
    }
  }
  const auto width = static_cast<std::uint32_t>(cols.size());
  for (std::uint32_t row = 0; row + 1 < rows.size(); ++row) {
    for (std::uint32_t col = 0; col + 1 < width; ++col) {
      const std::uint32_t corner = row * width + col;
      mesh.triangles.push_back({corner, corner + width, corner + width + 1});
      mesh.triangles.push_back({corner, corner + width + 1, corner + 1});
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh heightmap_mesh(const std::filesystem::path& file, const Eigen::Vector3d& size_m) {
  const auto refuse = [&file](const std::string& what) {
    throw InputError(file.string() + ": " + what);
  };
  const std::string bytes = read_text_file(file);
  if (!bytes.starts_with("\x89PNG")) refuse("a heightmap must be a PNG, convert it");
  Picture picture(bytes);
  if (!picture.read()) refuse(std::string("the PNG cannot be read: ") + picture.message());
  if (std::min(picture.width(), picture.height()) < 2) {
    refuse("a heightmap must have 2 x 2 pixels or more");
  }
  return terrain_of(picture, size_m);
}

}  // namespace nbvopt
