#include "map/depth_png.hpp"

#include <png.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <istream>
#include <new>
#include <span>
#include <string>
#include <vector>

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
    bytes_.resize(std::size_t{width()} * 2);
    if (!read_row_bytes()) return false;
    depths_.resize(width());
    for (std::size_t i = 0; i < depths_.size(); ++i) {  // PNG stores the high byte first
      depths_[i] = static_cast<std::uint16_t>(bytes_[2 * i] << 8 | bytes_[2 * i + 1]);
    }
    return true;
  }

  /// The row that was read last.
  std::span<const std::uint16_t> row() const { return depths_; }

  const char* message() const { return message_.data(); }

 private:
  bool read_row_bytes() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, bytes_.data(), nullptr);
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
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> depths_;
  std::array<char, 128> message_{};
};

}  // namespace

void for_each_png_row(std::istream& in, const std::string& name, const VisitDepthRow& visit) {
  PngRows image(in);
  const auto refuse = [&name](const std::string& what) { throw InputError(name + ": " + what); };
  if (!image.read_header()) refuse(std::string("the PNG cannot be read: ") + image.message());
  if (!image.is_depth_image()) {
    refuse("this PNG is no depth image: 16 bits of grey a pixel, not interlaced, are needed");
  }
  for (std::uint32_t row = 0; row < image.height(); ++row) {
    if (!image.read_row()) refuse(std::string("the PNG cannot be read: ") + image.message());
    visit(row, image.row());
  }
}

Scan read_depth_png(std::istream& in, const std::string& name, const DepthImageOptions& options) {
  options.validate();
  Scan scan;
  for_each_png_row(in, name, [&](std::uint32_t row, std::span<const std::uint16_t> pixels) {
    append_depth_row(pixels, row, options, scan);
  });
  return scan;
}

}  // namespace nbvopt
