#include "map/scan_windows.hpp"

#include <algorithm>
#include <unordered_map>

#include "map/mark_window.hpp"
#include "map/segment_walk.hpp"

namespace nbvopt {

namespace {

constexpr int kTileSize = MarkWindow::kTileSize;
constexpr int kWindowTiles = 4;  // an axis: marks of 16 MB at most
constexpr int kWindowSize = kWindowTiles * kTileSize;

/// Sorts the scan's work into windows that start at the least tile which the scan touches.
class WindowSorter {
 public:
  explicit WindowSorter(const ScanRays& rays) : rays_(rays) {
    Eigen::Vector3d least = rays.origin;
    Eigen::Vector3d most = rays.origin;
    for (const Eigen::Vector3d& end : rays.ends) {
      least = least.cwiseMin(end);
      most = most.cwiseMax(end);
    }
    first_tile_ = (least / kTileSize).cast<int>();
    last_tile_ = (most / kTileSize).cast<int>();
  }

  std::vector<WindowWork> sorted() && {
    for (std::uint32_t i = 0; i < rays_.ends.size(); ++i) add_ray(i);
    for (std::uint32_t i = 0; i < rays_.hits.size(); ++i) add_hit(i);
    std::ranges::sort(work_, {}, [](const WindowWork& work) { return packed(work.least); });
    return std::move(work_);
  }

 private:
  void add_ray(std::uint32_t ray) {
    const SegmentWalk walk(in_windows(rays_.origin), in_windows(rays_.ends[ray]));
    const auto add = [&](int a, int b, int c) {
      Eigen::Vector3i window;
      window[walk.a()] = a;
      window[walk.b()] = b;
      window[walk.c()] = c;
      at(window).rays.push_back(ray);
    };
    walk.for_each_slab([&](int slab, int b0, int c0, int b1, int c1) {
      add(slab, b0, c0);
      if (b1 != b0 || c1 != c0) add(slab, b1, c1);
    });
  }

  void add_hit(std::uint32_t hit) {
    const VoxelKey key = rays_.hits[hit].key;
    at((Eigen::Vector3i(key.x, key.y, key.z) - first_tile_ * kTileSize) / kWindowSize)
        .hits.push_back(hit);
  }

  /// A lattice point in a lattice of windows.
  Eigen::Vector3d in_windows(const Eigen::Vector3d& p) const {
    return (p - (first_tile_ * kTileSize).cast<double>()) / kWindowSize;
  }

  WindowWork& at(const Eigen::Vector3i& window) {
    if (window != recent_window_) {
      recent_window_ = window;
      recent_index_ = index_of(window);
    }
    return work_[recent_index_];
  }

  std::size_t index_of(const Eigen::Vector3i& window) {
    const std::uint64_t id = packed(key_of(window));
    const auto [entry, is_new] = index_.try_emplace(id, work_.size());
    if (is_new) {
      const Eigen::Vector3i tile = first_tile_ + window * kWindowTiles;
      const Eigen::Vector3i tiles =
          (last_tile_ - tile).cwiseMin(kWindowTiles - 1) + Eigen::Vector3i::Ones();
      work_.push_back({.least = key_of(tile * kTileSize),
                       .tiles = {tiles.x(), tiles.y(), tiles.z()},
                       .rays = {},
                       .hits = {}});
    }
    return entry->second;
  }

  static VoxelKey key_of(const Eigen::Vector3i& p) {
    return {static_cast<std::uint16_t>(p.x()), static_cast<std::uint16_t>(p.y()),
            static_cast<std::uint16_t>(p.z())};
  }

  const ScanRays& rays_;
  Eigen::Vector3i first_tile_, last_tile_;
  std::vector<WindowWork> work_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  Eigen::Vector3i recent_window_ = Eigen::Vector3i::Constant(-1);
  std::size_t recent_index_ = 0;
};

}  // namespace

std::vector<WindowWork> scan_windows(const ScanRays& rays) { return WindowSorter(rays).sorted(); }

}  // namespace nbvopt
