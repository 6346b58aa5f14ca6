#include "sim/world/stray_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

namespace nbvopt {

namespace {

/// Nothing nearer than this is stray, however small the world: it is beyond any sensor's range.
constexpr double kStrayDistanceMin_m = 1000.0;
/// A city's quarters are a few times farther from its middle than most of it; not this often.
constexpr double kStrayDistanceFactor = 100.0;

Eigen::AlignedBox3d bounds_of(const WorldPart& part) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex_m : part.mesh.vertices_m) box.extend(vertex_m.cast<double>());
  return box;
}

/// The median over parts, each counted by its triangles: two boxes lost in the distance do not
/// outvote a house that is one mesh. Of two middle values, the one nearer to zero.
double weighted_median(const std::vector<WorldPart>& parts, const std::vector<double>& values) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t part) { return values[part]; });
  const auto weight = [&](std::size_t part) { return parts[part].mesh.triangles.size(); };
  const std::size_t total =
      std::transform_reduce(order.begin(), order.end(), std::size_t{0}, std::plus<>(), weight);
  std::size_t below = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    below += weight(order[i]);
    const double value = values[order[i]];
    if (2 * below > total) return value;
    if (2 * below == total) {
      const double next = values[order[i + 1]];
      return std::abs(value) <= std::abs(next) ? value : next;
    }
  }
  return 0.0;  // no parts
}

}  // namespace

void remove_stray_parts(std::vector<WorldPart>& parts, WorldLog& log) {
  std::vector<Eigen::AlignedBox3d> boxes(parts.size());
  std::ranges::transform(parts, boxes.begin(), bounds_of);
  const auto median_of = [&](auto value) {
    std::vector<double> values(parts.size());
    std::ranges::transform(boxes, values.begin(), value);
    return weighted_median(parts, values);
  };
  Eigen::Vector3d middle_m;
  for (int axis = 0; axis < 3; ++axis) {
    middle_m[axis] = median_of([=](const auto& box) { return box.center()[axis]; });
  }
  const auto distance_m = [&](const auto& box) { return (box.center() - middle_m).norm(); };
  const double reach_m =
      median_of([&](const auto& box) { return distance_m(box) + 0.5 * box.diagonal().norm(); });
  const double limit_m = std::max(kStrayDistanceMin_m, kStrayDistanceFactor * reach_m);

  std::vector<WorldPart> kept;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // Distances of planes mean nothing.
    if (parts[i].is_plane || distance_m(boxes[i]) <= limit_m) {
      kept.push_back(std::move(parts[i]));
    } else {
      log.left_out("model '" + parts[i].model + "' is left out: it lies " +
                   std::to_string(std::lround(distance_m(boxes[i]) / 1000.0)) +
                   " km from the middle of the world");
    }
  }
  parts = std::move(kept);
}

}  // namespace nbvopt
