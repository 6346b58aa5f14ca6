#include "map/scan_windows.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "map/mark_window.hpp"
#include "map/segment_walk.hpp"

namespace nbvopt {

namespace {

constexpr int kTileSize = MarkWindow::kTileSize;
constexpr int kWindowTiles = 4;  // an axis: marks of 16 MB at most
constexpr int kWindowSize = kWindowTiles * kTileSize;

constexpr std::uint64_t kNone = ~std::uint64_t{0};

/// A coordinate's part of a packed key.
struct PackedPart {
  int shift;
  std::uint64_t operator[](int coordinate) const {
    return static_cast<std::uint64_t>(coordinate) << shift;
  }
};
constexpr std::array kPacked{PackedPart{0}, PackedPart{16}, PackedPart{32}};

/// Sorts the scan's work into windows that start at the least tile which the scan touches.
class WindowSorter {
 public:
  explicit WindowSorter(ScanRays rays) : rays_(std::move(rays)) {
    const Eigen::AlignedBox3d box = rays_.ends.box().extend(rays_.origin);
    first_tile_ = (box.min() / kTileSize).cast<int>();
    last_tile_ = (box.max() / kTileSize).cast<int>();
  }

  std::vector<WindowWork> sorted() && {
    if (((last_tile_ - first_tile_).array() < kWindowTiles).all()) {
      work_.push_back(window_at(Eigen::Vector3i::Zero()));
      work_.front().rays = std::move(rays_);
      return std::move(work_);
    }
    for (std::size_t ray = 0; ray < rays_.ends.size(); ++ray) add_ray(rays_.ends[ray]);
    for (const ScanHit& hit : rays_.hits) add_hit(hit);
    std::ranges::sort(work_, {}, [](const WindowWork& work) { return packed(work.least); });
    return std::move(work_);
  }

 private:
  /// A window without rays and hits, by its place among the windows.
  WindowWork window_at(const Eigen::Vector3i& place) const {
    const Eigen::Vector3i tile = first_tile_ + place * kWindowTiles;
    const Eigen::Vector3i tiles =
        (last_tile_ - tile).cwiseMin(kWindowTiles - 1) + Eigen::Vector3i::Ones();
    WindowWork work{key_of(tile * kTileSize), {tiles.x(), tiles.y(), tiles.z()}, {}};
    work.rays.origin = rays_.origin;
    return work;
  }

  void add_ray(const Eigen::Vector3d& end) {
    const SegmentWalk walk(in_windows(rays_.origin), in_windows(end));
    std::uint64_t recent = kNone;
    walk.for_each_cell(kPacked, [&](std::uint64_t window) {
      if (window != recent) at(window).rays.ends.add(end);
      recent = window;
    });
  }

  void add_hit(const ScanHit& hit) {
    const Eigen::Vector3i voxel =
        Eigen::Vector3i(hit.key.x, hit.key.y, hit.key.z) - first_tile_ * kTileSize;
    at(packed(key_of(voxel / kWindowSize))).rays.hits.push_back(hit);
  }

  /// A lattice point in a lattice of windows.
  Eigen::Vector3d in_windows(const Eigen::Vector3d& p) const {
    return (p - (first_tile_ * kTileSize).cast<double>()) / kWindowSize;
  }

  /// The work of a window, named by the packed key of its place among the windows.
  WindowWork& at(std::uint64_t window) {
    if (window != recent_window_) {
      recent_window_ = window;
      recent_index_ = index_of(window);
    }
    return work_[recent_index_];
  }

  std::size_t index_of(std::uint64_t window) {
    const auto [entry, is_new] = index_.try_emplace(window, work_.size());
    if (is_new) {
      work_.push_back(window_at(
          Eigen::Vector3i(window & 0xFFFF, window >> 16 & 0xFFFF, window >> 32 & 0xFFFF)));
    }
    return entry->second;
  }

  static VoxelKey key_of(const Eigen::Vector3i& p) {
    return {static_cast<std::uint16_t>(p.x()), static_cast<std::uint16_t>(p.y()),
            static_cast<std::uint16_t>(p.z())};
  }

  ScanRays rays_;
  Eigen::Vector3i first_tile_, last_tile_;
  std::vector<WindowWork> work_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::uint64_t recent_window_ = kNone;
  std::size_t recent_index_ = 0;
};

}  // namespace

std::vector<WindowWork> scan_windows(ScanRays rays) {
  return WindowSorter(std::move(rays)).sorted();
}

}  // namespace nbvopt
