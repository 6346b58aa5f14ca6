// A page to draw on: shapes and text in points from the top left, kept as a PNG image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Cairo stays in canvas.cpp.
struct _cairo;  // NOLINT(bugprone-reserved-identifier): its own name

namespace nbvopt {

/// Red, green, blue and opacity, in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;

  Colour with_alpha(double value) const { return {red, green, blue, value}; }
};

/// 0xRRGGBB as people write colours.
constexpr Colour rgb(std::uint32_t hex) {
  return {(hex >> 16 & 0xFF) / 255.0, (hex >> 8 & 0xFF) / 255.0, (hex & 0xFF) / 255.0};
}

struct Rectangle {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct Stroke {
  Colour colour;
  double width = 1.0;
  std::vector<double> dashes = {};  ///< lengths of dash and gap; empty: solid
};

enum class Anchor { left, centre, right };

struct TextStyle {
  double size = 12.0;
  Colour colour;
  bool bold = false;
  Anchor anchor = Anchor::left;
};

/// Cells of one colour each, row by row from the top left.
struct Raster {
  int columns = 0;
  int rows = 0;
  std::vector<Colour> cells;
};

class Canvas {
 public:
  /// A white page.
  Canvas(double width, double height, double pixels_per_point);

  void fill(const Rectangle& rectangle, Colour colour);
  void stroke(const Rectangle& rectangle, const Stroke& stroke);
  void fill(std::span<const Eigen::Vector2d> polygon, Colour colour);
  void stroke_closed(std::span<const Eigen::Vector2d> polygon, const Stroke& stroke);
  void stroke_open(std::span<const Eigen::Vector2d> line, const Stroke& stroke);
  void disc(const Eigen::Vector2d& centre, double radius, Colour fill, const Stroke& outline);

  /// The baseline starts, has its middle or ends at `at`.
  void text(const Eigen::Vector2d& at, const std::string& text, const TextStyle& style);
  /// The same, read from below.
  void upright_text(const Eigen::Vector2d& at, const std::string& text, const TextStyle& style);
  double text_width(const std::string& text, const TextStyle& style) const;

  /// Stretches the raster over the rectangle; cells keep sharp edges.
  void draw(const Raster& raster, const Rectangle& rectangle);

  /// Runs `drawing`, and cuts what it draws at the rectangle.
  void clipped(const Rectangle& rectangle, const std::function<void()>& drawing);

  /// The page as a PNG file's bytes. Throws Error when Cairo failed, now or before.
  std::string png() const;

 private:
  void trace(std::span<const Eigen::Vector2d> points);
  void paint(const Stroke& stroke);
  void select(const TextStyle& style) const;

  std::unique_ptr<_cairo, void (*)(_cairo*)> cairo_;
};

}  // namespace nbvopt
