#include "sim/world/extrusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr std::size_t kPointsMax = 1000;

struct Edge {
  Eigen::Vector2d low;
  Eigen::Vector2d high;

  bool is_level() const { return low.y() == high.y(); }

  /// Exact at both ends, so that neighbours meet.
  double x_at(double y) const {
    if (y == low.y()) return low.x();
    if (y == high.y()) return high.x();
    return low.x() + (high.x() - low.x()) * (y - low.y()) / (high.y() - low.y());
  }
};

std::vector<Edge> edges_of(const std::vector<std::vector<Eigen::Vector2d>>& outlines) {
  std::vector<Edge> edges;
  for (const auto& outline : outlines) {
    if (outline.size() < 3) throw InputError("its outline has fewer than 3 points");
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d& from = outline[i];
      const Eigen::Vector2d& to = outline[(i + 1) % outline.size()];
      if (from == to) continue;
      edges.push_back(from.y() <= to.y() ? Edge{from, to} : Edge{to, from});
    }
    if (edges.size() > kPointsMax) {
      throw InputError("its outlines have more than " + std::to_string(kPointsMax) + " points");
    }
  }
  return edges;
}

/// The height of the point in the inside of two edges where they cross.
std::optional<double> crossing_y(const Edge& a, const Edge& b) {
  const double from_y = std::max(a.low.y(), b.low.y());
  const double to_y = std::min(a.high.y(), b.high.y());
  if (a.is_level() || b.is_level() || from_y >= to_y) return std::nullopt;
  const double before = a.x_at(from_y) - b.x_at(from_y);
  const double after = a.x_at(to_y) - b.x_at(to_y);
  if (before * after >= 0.0) return std::nullopt;
  return from_y + (to_y - from_y) * before / (before - after);
}

/// The plane cut into slabs along y so that no edge ends or is crossed within one. In a slab the
/// inside is made of trapezoids.
class Slabs {
 public:
  explicit Slabs(const std::vector<Edge>& edges) : edges_(edges) {
    for (const Edge& edge : edges) {
      ys_.push_back(edge.low.y());
      ys_.push_back(edge.high.y());
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (const auto y = crossing_y(edges[i], edges[k])) ys_.push_back(*y);
      }
      if (ys_.size() > 4 * kPointsMax) throw InputError("its outlines cross too often");
    }
    std::ranges::sort(ys_);
    ys_.erase(std::unique(ys_.begin(), ys_.end()), ys_.end());
    for (const double y : ys_) xs_.push_back(xs_on(y));
  }

  std::size_t size() const { return ys_.empty() ? 0 : ys_.size() - 1; }
  double y(std::size_t slab) const { return ys_[slab]; }

  /// The edges through a slab from left to right.
  std::vector<const Edge*> edges_through(std::size_t slab) const {
    std::vector<const Edge*> through;
    const double low = ys_[slab];
    const double high = ys_[slab + 1];
    for (const Edge& edge : edges_) {
      if (!edge.is_level() && edge.low.y() <= low && edge.high.y() >= high)
        through.push_back(&edge);
    }
    std::ranges::sort(through, {},
                      [=](const Edge* edge) { return edge->x_at(low) + edge->x_at(high); });
    return through;
  }

  /// The points of a slab's lower border from one x to another, all corners between among them:
  /// triangles on either side then share their edges.
  std::vector<Eigen::Vector2d> border(std::size_t slab, double from_x, double to_x) const {
    std::vector<Eigen::Vector2d> points{{from_x, ys_[slab]}};
    const std::vector<double>& xs = xs_[slab];
    for (auto x = std::ranges::upper_bound(xs, from_x); x != xs.end() && *x < to_x; ++x) {
      points.emplace_back(*x, ys_[slab]);
    }
    if (to_x > from_x) points.emplace_back(to_x, ys_[slab]);
    return points;
  }

  /// Whether the inside lies above a border where no corner is, or below it.
  bool is_inside_above(std::size_t border, double x) const {
    return border < size() && is_inside(border, ys_[border], x);
  }
  bool is_inside_below(std::size_t border, double x) const {
    return border > 0 && is_inside(border - 1, ys_[border], x);
  }

  /// The border that has this y.
  std::size_t border_at(double y) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(ys_, y) - ys_.begin());
  }

 private:
  bool is_inside(std::size_t slab, double y, double x) const {
    const std::vector<const Edge*> through = edges_through(slab);
    return std::ranges::count_if(through, [=](const Edge* edge) { return edge->x_at(y) < x; }) %
               2 ==
           1;
  }

  std::vector<double> xs_on(double y) const {
    std::vector<double> xs;
    for (const Edge& edge : edges_) {
      if (edge.low.y() > y || edge.high.y() < y) continue;
      xs.push_back(edge.x_at(y));
      if (edge.is_level()) xs.push_back(edge.high.x());
    }
    std::ranges::sort(xs);
    xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
    return xs;
  }

  const std::vector<Edge>& edges_;
  std::vector<double> ys_;
  std::vector<std::vector<double>> xs_;  // of corners, on each border
};

class Solid {
 public:
  explicit Solid(double height_m) : height_m_(height_m) {}

  /// What lies between two level chains, each from left to right.
  void add_caps(const std::vector<Eigen::Vector2d>& low, const std::vector<Eigen::Vector2d>& high) {
    std::size_t i = 0;
    std::size_t k = 0;
    while (i + 1 < low.size() || k + 1 < high.size()) {
      const bool is_low_next =
          k + 1 == high.size() || (i + 1 < low.size() && low[i + 1].x() <= high[k + 1].x());
      const Eigen::Vector2d& next = is_low_next ? low[i + 1] : high[k + 1];
      add_triangle(at(low[i], height_m_), at(next, height_m_), at(high[k], height_m_));
      add_triangle(at(low[i], 0.0), at(high[k], 0.0), at(next, 0.0));
      ++(is_low_next ? i : k);
    }
  }

  /// A wall, the outside to the right of the way.
  void add_wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    add_triangle(at(from, 0.0), at(to, 0.0), at(to, height_m_));
    add_triangle(at(from, 0.0), at(to, height_m_), at(from, height_m_));
  }

  TriangleMesh mesh;

 private:
  static Eigen::Vector3f at(const Eigen::Vector2d& point, double z) {
    return Eigen::Vector3d(point.x(), point.y(), z).cast<float>();
  }

  void add_triangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const Eigen::Vector3f& corner : {a, b, c}) mesh.vertices_m.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }

  double height_m_;
};

void add_level_walls(const Edge& edge, const Slabs& slabs, Solid& solid) {
  const auto [from_x, to_x] = std::minmax(edge.low.x(), edge.high.x());
  const std::size_t border = slabs.border_at(edge.low.y());
  const std::vector<Eigen::Vector2d> points = slabs.border(border, from_x, to_x);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double middle_x = 0.5 * (points[i].x() + points[i + 1].x());
    const bool is_inside_above = slabs.is_inside_above(border, middle_x);
    if (is_inside_above == slabs.is_inside_below(border, middle_x)) continue;
    if (is_inside_above) {
      solid.add_wall(points[i], points[i + 1]);
    } else {
      solid.add_wall(points[i + 1], points[i]);
    }
  }
}

}  // namespace

TriangleMesh extruded_mesh(const std::vector<std::vector<Eigen::Vector2d>>& outlines_m,
                           double height_m) {
  const std::vector<Edge> edges = edges_of(outlines_m);
  const Slabs slabs(edges);
  Solid solid(height_m);
  for (std::size_t slab = 0; slab < slabs.size(); ++slab) {
    const double low = slabs.y(slab);
    const double high = slabs.y(slab + 1);
    const std::vector<const Edge*> through = slabs.edges_through(slab);
    for (std::size_t i = 0; i + 1 < through.size(); i += 2) {  // inside between odd and even ones
      const Edge& left = *through[i];
      const Edge& right = *through[i + 1];
      solid.add_caps(slabs.border(slab, left.x_at(low), right.x_at(low)),
                     slabs.border(slab + 1, left.x_at(high), right.x_at(high)));
      solid.add_wall({left.x_at(high), high}, {left.x_at(low), low});
      solid.add_wall({right.x_at(low), low}, {right.x_at(high), high});
    }
  }
  for (const Edge& edge : edges) {
    if (edge.is_level()) add_level_walls(edge, slabs, solid);
  }
  return std::move(solid.mesh);
}

}  // namespace nbvopt
