#include <png.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <istream>
#include <new>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

/// Reads the image row by row, so that memory follows what the file holds, not what it says.
/// libpng leaves its functions by longjmp(), over which no C++ object may live: each function
/// below that calls it owns nothing, and what they fill are members.
class PngRows {
 public:
  explicit PngRows(std::istream& in) : in_(in) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
    png_set_read_fn(png_, this, on_read);
  }
  PngRows(const PngRows&) = delete;
  PngRows& operator=(const PngRows&) = delete;
  ~PngRows() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_info(png_, info_);
    return true;
  }

  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }
  bool is_depth_image() const {
    return png_get_bit_depth(png_, info_) == 16 &&
           png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY &&
           png_get_interlace_type(png_, info_) == PNG_INTERLACE_NONE;
  }

  bool read_row() {
    row_.resize(std::size_t{width()} * 2);
    return read_row_bytes();
  }

  /// A pixel of the row that was read last; PNG stores the high byte first.
  std::uint16_t depth(std::uint32_t column) const {
    return static_cast<std::uint16_t>(row_[2 * column] << 8 | row_[2 * column + 1]);
  }

  const char* message() const { return message_.data(); }

 private:
  bool read_row_bytes() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row_.data(), nullptr);
    return true;
  }

  static void on_read(png_structp png, png_bytep bytes, std::size_t count) {
    auto& self = *static_cast<PngRows*>(png_get_io_ptr(png));
    self.in_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(count));
    if (static_cast<std::size_t>(self.in_.gcount()) != count) png_error(png, "it is truncated");
  }

  static void on_error(png_structp png, png_const_charp message) {
    auto& self = *static_cast<PngRows*>(png_get_error_ptr(png));
    std::snprintf(self.message_.data(), self.message_.size(), "%s", message);
    png_longjmp(png, 1);
  }

  static void on_warning(png_structp, png_const_charp) {}

  std::istream& in_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<std::uint8_t> row_;
  std::array<char, 128> message_{};
};

void check_positive(const char* field, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InputError(std::string("depth image: ") + field + " is " + format_number(value) +
                     ", it must be positive and finite");
  }
}

void check_finite(const char* field, double value) {
  if (!std::isfinite(value)) {
    throw InputError(std::string("depth image: ") + field + " is " + format_number(value) +
                     ", it must be finite");
  }
}

}  // namespace

void DepthImageOptions::validate() const {
  check_positive("fx_px", fx_px);
  check_positive("fy_px", fy_px);
  check_finite("cx_px", cx_px);
  check_finite("cy_px", cy_px);
  check_positive("depth_scale_m", depth_scale_m);
}

Scan read_depth_png(std::istream& in, const std::string& name, const DepthImageOptions& options) {
  constexpr std::uint16_t kNotKnown = 0;
  constexpr std::uint16_t kNothingInRange = 65535;
  options.validate();
  PngRows image(in);
  const auto refuse = [&name](const std::string& what) { throw InputError(name + ": " + what); };
  if (!image.read_header()) refuse(std::string("the PNG cannot be read: ") + image.message());
  if (!image.is_depth_image()) {
    refuse("this PNG is no depth image: 16 bits of grey a pixel, not interlaced, are needed");
  }
  Scan scan;
  for (std::uint32_t v = 0; v < image.height(); ++v) {
    if (!image.read_row()) refuse(std::string("the PNG cannot be read: ") + image.message());
    for (std::uint32_t u = 0; u < image.width(); ++u) {
      const std::uint16_t depth = image.depth(u);
      if (depth == kNotKnown) continue;
      const Eigen::Vector3d direction((u - options.cx_px) / options.fx_px,
                                      (v - options.cy_px) / options.fy_px, 1.0);
      if (depth == kNothingInRange) {
        scan.no_returns.push_back(direction.cast<float>());
      } else {
        scan.points_m.push_back((direction * (depth * options.depth_scale_m)).cast<float>());
      }
    }
  }
  return scan;
}

}  // namespace nbvopt
