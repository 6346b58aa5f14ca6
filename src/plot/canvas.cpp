#include "plot/canvas.hpp"

#include <cairo.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

void set_colour(cairo_t* cairo, const Colour& colour) {
  cairo_set_source_rgba(cairo, colour.red, colour.green, colour.blue, colour.alpha);
}

std::uint32_t pixel(const Colour& colour) {
  const auto byte = [](double value) {
    return static_cast<std::uint32_t>(std::lround(255 * value));
  };
  return byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
}

}  // namespace

Canvas::Canvas(double width, double height, double pixels_per_point)
    : cairo_(nullptr, cairo_destroy) {
  cairo_surface_t* surface = cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width * pixels_per_point)),
      static_cast<int>(std::ceil(height * pixels_per_point)));
  cairo_.reset(cairo_create(surface));
  cairo_surface_destroy(surface);  // the context holds it
  cairo_scale(cairo_.get(), pixels_per_point, pixels_per_point);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  fill(Rectangle{0.0, 0.0, width, height}, rgb(0xFFFFFF));
}

void Canvas::fill(const Rectangle& rectangle, Colour colour) {
  cairo_rectangle(cairo_.get(), rectangle.x, rectangle.y, rectangle.width, rectangle.height);
  set_colour(cairo_.get(), colour);
  cairo_fill(cairo_.get());
}

void Canvas::stroke(const Rectangle& rectangle, const Stroke& stroke) {
  cairo_rectangle(cairo_.get(), rectangle.x, rectangle.y, rectangle.width, rectangle.height);
  paint(stroke);
}

void Canvas::fill(std::span<const Eigen::Vector2d> polygon, Colour colour) {
  trace(polygon);
  set_colour(cairo_.get(), colour);
  cairo_fill(cairo_.get());
}

void Canvas::stroke_closed(std::span<const Eigen::Vector2d> polygon, const Stroke& stroke) {
  trace(polygon);
  cairo_close_path(cairo_.get());
  paint(stroke);
}

void Canvas::stroke_open(std::span<const Eigen::Vector2d> line, const Stroke& stroke) {
  trace(line);
  paint(stroke);
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, Colour fill,
                  const Stroke& outline) {
  cairo_new_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  set_colour(cairo_.get(), fill);
  cairo_fill_preserve(cairo_.get());
  paint(outline);
}

void Canvas::text(const Eigen::Vector2d& at, const std::string& text, const TextStyle& style) {
  select(style);
  const double share = style.anchor == Anchor::left     ? 0.0
                       : style.anchor == Anchor::centre ? 0.5
                                                        : 1.0;
  cairo_move_to(cairo_.get(), at.x() - share * text_width(text, style), at.y());
  set_colour(cairo_.get(), style.colour);
  cairo_show_text(cairo_.get(), text.c_str());
  cairo_new_path(cairo_.get());
}

void Canvas::upright_text(const Eigen::Vector2d& at, const std::string& words,
                          const TextStyle& style) {
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), at.x(), at.y());
  cairo_rotate(cairo_.get(), -0.5 * std::numbers::pi);
  text({0.0, 0.0}, words, style);
  cairo_restore(cairo_.get());
}

double Canvas::text_width(const std::string& text, const TextStyle& style) const {
  select(style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::draw(const Raster& raster, const Rectangle& rectangle) {
  cairo_surface_t* image =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, raster.columns, raster.rows);
  unsigned char* bytes = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int row = 0; row < raster.rows; ++row) {
    auto* pixels = reinterpret_cast<std::uint32_t*>(bytes + std::ptrdiff_t{row} * stride);
    for (int column = 0; column < raster.columns; ++column) {
      pixels[column] = pixel(raster.cells[std::size_t(row) * raster.columns + column]);
    }
  }
  cairo_surface_mark_dirty(image);
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), rectangle.x, rectangle.y);
  cairo_scale(cairo_.get(), rectangle.width / raster.columns, rectangle.height / raster.rows);
  cairo_set_source_surface(cairo_.get(), image, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo_.get()), CAIRO_FILTER_NEAREST);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
  cairo_surface_destroy(image);
}

void Canvas::clipped(const Rectangle& rectangle, const std::function<void()>& drawing) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), rectangle.x, rectangle.y, rectangle.width, rectangle.height);
  cairo_clip(cairo_.get());
  drawing();
  cairo_restore(cairo_.get());
}

std::string Canvas::png() const {
  std::string bytes;
  const auto append = [](void* out, const unsigned char* data, unsigned int size) {
    static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_status_t status = cairo_status(cairo_.get());
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(cairo_get_target(cairo_.get()), append, &bytes);
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw Error(std::string("the picture cannot be drawn: ") + cairo_status_to_string(status));
  }
  return bytes;
}

void Canvas::trace(std::span<const Eigen::Vector2d> points) {
  cairo_new_path(cairo_.get());
  for (const Eigen::Vector2d& point : points) cairo_line_to(cairo_.get(), point.x(), point.y());
}

void Canvas::paint(const Stroke& stroke) {
  set_colour(cairo_.get(), stroke.colour);
  cairo_set_line_width(cairo_.get(), stroke.width);
  cairo_set_dash(cairo_.get(), stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0.0);
  cairo_stroke(cairo_.get());
}

void Canvas::select(const TextStyle& style) const {
  cairo_select_font_face(cairo_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_.get(), style.size);
}

}  // namespace nbvopt
