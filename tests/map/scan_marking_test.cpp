#include "map/scan_marking.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <random>

#include "map/segment_walk.hpp"

namespace nbvopt {
namespace {

constexpr int kTiles = 3;
constexpr int kSize = kTiles * MarkWindow::kTileSize;
constexpr int kLeast = 32768;

MarkWindow empty_window() {
  constexpr auto kCorner = static_cast<std::uint16_t>(kLeast);
  return {{kCorner, kCorner, kCorner}, {kTiles, kTiles, kTiles}};
}

/// What is marked, voxel by voxel.
std::vector<std::uint8_t> marks(MarkWindow& window) {
  window.finish();
  const auto marks = window.contents(0);
  return {marks.begin(), marks.end()};
}

std::vector<std::uint8_t> marks_of(const ScanRays& rays) {
  MarkWindow window = empty_window();
  for (const ScanHit& hit : rays.hits) window.mark_hit(hit.key);
  mark_rays(rays, {}, window);
  return marks(window);
}

/// The oracle: every ray is walked from end to end.
std::vector<std::uint8_t> marks_ray_by_ray(const ScanRays& rays) {
  MarkWindow window = empty_window();
  for (const ScanHit& hit : rays.hits) window.mark_hit(hit.key);
  for (std::size_t ray = 0; ray < rays.ends.size(); ++ray) {
    window.mark_passed(SegmentWalk(rays.origin, rays.ends[ray]), kAllSlabs);
  }
  return marks(window);
}

/// What a camera sees from somewhere in a room with pillars, in lattice coordinates.
class RandomView {
 public:
  explicit RandomView(unsigned seed) : random_(seed) {}

  double number(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  Eigen::Vector3d point(double least, double most) {
    return {number(least, most), number(least, most), number(least, most)};
  }

  /// An image of `width` columns, row by row, with a share of pixels that are not known.
  ScanRays rays(int width, double range, double missing, double noise) {
    ScanRays rays;
    rays.origin = Eigen::Vector3d::Constant(kLeast) + point(0.3 * kSize, 0.7 * kSize);
    const Eigen::Quaterniond turn(
        Eigen::Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1))
            .normalized());
    const Eigen::Vector3d normal = point(-1.0, 1.0).normalized();
    const double wall = number(2.0, range);
    const double pillar_left = number(-0.5, 0.3);
    const double pillar = number(1.0, range);
    const double step = 1.1 / width;
    for (double v = -0.4; v < 0.4; v += step) {
      for (double u = -0.55; u < 0.55; u += step) {
        if (number(0.0, 1.0) < missing) continue;
        const Eigen::Vector3d direction = (turn * Eigen::Vector3d(u, v, 1.0)).normalized();
        double length = wall / std::max(1e-3, std::abs(normal.dot(direction)));
        if (u > pillar_left && u < pillar_left + 0.2) length = std::min(length, pillar);
        length *= 1.0 + number(-noise, noise);
        add(rays, direction, length, range);
      }
    }
    return rays;
  }

  void shuffle(ScanRays& rays) {
    std::vector<Eigen::Vector3d> ends;
    for (std::size_t ray = 0; ray < rays.ends.size(); ++ray) ends.push_back(rays.ends[ray]);
    std::ranges::shuffle(ends, random_);
    rays.ends = {};
    for (const Eigen::Vector3d& end : ends) rays.ends.add(end);
  }

 private:
  static void add(ScanRays& rays, const Eigen::Vector3d& direction, double length, double range) {
    const Eigen::Vector3d end = rays.origin + direction * std::min(length, range);
    rays.ends.add(end);
    const Eigen::Vector3i voxel = end.cast<int>();
    const bool is_inside = ((voxel.array() >= kLeast) && (voxel.array() < kLeast + kSize)).all();
    if (length >= range || !is_inside) return;
    rays.hits.push_back(
        {{static_cast<std::uint16_t>(voxel.x()), static_cast<std::uint16_t>(voxel.y()),
          static_cast<std::uint16_t>(voxel.z())},
         0});
  }

  std::mt19937 random_;
};

/// Rays a voxel apart and a hundredth; views that fill the window or leave it on all sides.
TEST(MarkRays, MarksWhatTheRaysPassOneByOne) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    RandomView view(seed);
    const double range = view.number(3.0, seed % 4 == 0 ? 2.0 * kSize : 0.4 * kSize);
    const double missing = seed % 3 == 0 ? view.number(0.0, 0.9) : 0.0;
    const double noise = seed % 2 == 0 ? 0.0 : view.number(0.0, 0.1);
    const ScanRays rays = view.rays(seed % 5 == 0 ? 30 : 150, range, missing, noise);
    EXPECT_EQ(marks_of(rays), marks_ray_by_ray(rays)) << "seed " << seed;
  }
}

TEST(MarkRays, DoesNotDependOnTheNumberOfThreads) {
  const ScanRays rays = RandomView(11).rays(300, 0.4 * kSize, 0.1, 0.01);
  const auto marks_by = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return marks_of(rays); });
  };
  EXPECT_EQ(marks_by(1), marks_by(2));
}

TEST(MarkRays, DoesNotDependOnTheOrderOfTheRays) {
  RandomView view(7);
  ScanRays rays = view.rays(100, 0.4 * kSize, 0.0, 0.02);
  const auto in_order = marks_of(rays);
  view.shuffle(rays);
  EXPECT_EQ(marks_of(rays), in_order);
}

/// Faces, edges and corners of voxels, along axes and diagonals, where rounding decides.
TEST(MarkRays, MarksTheSameOnWholeNumbers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomView view(seed);
    ScanRays rays;
    rays.origin = (Eigen::Vector3d::Constant(kLeast) + view.point(20.0, 100.0)).array().floor();
    if (seed % 2 == 0) rays.origin.x() += 0.5;
    const Eigen::Vector3d corner =
        (Eigen::Vector3d::Constant(kLeast) + view.point(0.0, 150.0)).array().floor();
    for (double x = 0.0; x < 12.0; x += 0.25) {
      for (double y = 0.0; y < 12.0; y += 0.25) {
        rays.ends.add(corner + Eigen::Vector3d(x, y, seed % 3 == 0 ? 0.0 : x));
      }
    }
    EXPECT_EQ(marks_of(rays), marks_ray_by_ray(rays)) << "seed " << seed;
  }
}

TEST(MarkRays, LeavesOffOnceItIsCancelled) {
  const ScanRays rays = RandomView(3).rays(50, 20.0, 0.0, 0.0);
  CancelToken cancel;
  cancel.cancel();
  MarkWindow window = empty_window();
  mark_rays(rays, cancel, window);
  EXPECT_EQ(marks(window), std::vector<std::uint8_t>(kSize * kSize * kSize, kUntouched));
}

}  // namespace
}  // namespace nbvopt
