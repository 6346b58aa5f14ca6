#include "map/scan_windows.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

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
    if (((last_tile_ - first_tile_).array() < kWindowTiles).all()) return {whole_scan()};
    for (std::uint32_t i = 0; i < rays_.ends.size(); ++i) add_ray(i);
    for (std::uint32_t i = 0; i < rays_.hits.size(); ++i) add_hit(i);
    std::ranges::sort(work_, {}, [](const WindowWork& work) { return packed(work.least); });
    return std::move(work_);
  }

 private:
  /// The one window that holds all.
  WindowWork whole_scan() const {
    WindowWork work = window_at(Eigen::Vector3i::Zero());
    work.rays.resize(rays_.ends.size());
    work.hits.resize(rays_.hits.size());
    std::iota(work.rays.begin(), work.rays.end(), 0U);
    std::iota(work.hits.begin(), work.hits.end(), 0U);
    return work;
  }

  /// A window without its work, by its place among the windows.
  WindowWork window_at(const Eigen::Vector3i& place) const {
    const Eigen::Vector3i tile = first_tile_ + place * kWindowTiles;
    const Eigen::Vector3i tiles =
        (last_tile_ - tile).cwiseMin(kWindowTiles - 1) + Eigen::Vector3i::Ones();
    return {.least = key_of(tile * kTileSize),
            .tiles = {tiles.x(), tiles.y(), tiles.z()},
            .rays = {},
            .hits = {}};
  }

  void add_ray(std::uint32_t ray) {
    const SegmentWalk walk(in_windows(rays_.origin), in_windows(rays_.ends[ray]));
    std::uint64_t recent = kNone;
    walk.for_each_cell(kPacked, [&](std::uint64_t window) {
      if (window != recent) at(window).rays.push_back(ray);
      recent = window;
    });
  }

  void add_hit(std::uint32_t hit) {
    const VoxelKey key = rays_.hits[hit].key;
    const Eigen::Vector3i voxel = Eigen::Vector3i(key.x, key.y, key.z) - first_tile_ * kTileSize;
    at(packed(key_of(voxel / kWindowSize))).hits.push_back(hit);
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

  const ScanRays& rays_;
  Eigen::Vector3i first_tile_, last_tile_;
  std::vector<WindowWork> work_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
  std::uint64_t recent_window_ = kNone;
  std::size_t recent_index_ = 0;
};

}  // namespace

std::vector<WindowWork> scan_windows(const ScanRays& rays) { return WindowSorter(rays).sorted(); }

}  // namespace nbvopt
