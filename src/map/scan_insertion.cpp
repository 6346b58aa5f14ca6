#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "map/hit_marking.hpp"
#include "map/insertion_size.hpp"
#include "map/map_access.hpp"
#include "map/mark_window.hpp"
#include "map/scan_counting.hpp"
#include "map/scan_marking.hpp"
#include "map/scan_rays.hpp"
#include "map/scan_uncertainty.hpp"
#include "map/scan_windows.hpp"
#include "map/tile_undo.hpp"
#include "map/tile_update.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

namespace {

/// Writes a scan into a tree, window by window. Where there is one, it is written in one go once
/// it is marked; where there are several, what they replace is kept, so that an Error between two
/// tiles leaves nothing behind.
class WindowWriter {
 public:
  WindowWriter(UncertaintyOcTree& tree, const Scan& scan, const ScanUncertainty& uncertainty,
               const InsertLimits& limits, InsertResult& result)
      : tree_(tree),
        scan_(scan),
        uncertainty_(uncertainty),
        limits_(limits),
        result_(result),
        undo_(tree) {}

  void write(const std::vector<WindowWork>& windows) {
    is_undone_ = windows.size() > 1;
    try {
      for (const WindowWork& work : windows) write(work);
    } catch (const Error&) {
      undo_.restore();
      throw;
    }
  }

 private:
  void write(const WindowWork& work) {
    MarkWindow window(work.least, work.tiles);
    mark(work, window);
    reserve_memory(window);
    check_cancelled();
    TileUpdate update(tree_, window, result_);
    for (std::uint32_t tile = 0; tile < window.tile_count(); ++tile) {
      if (is_undone_ && window.content(MarkWindow::kTileBits, tile) != kUntouched) {
        check_cancelled();
        undo_.keep(window.key(tile << 3 * MarkWindow::kTileBits));
      }
      update.apply(tile);
    }
  }

  void mark(const WindowWork& work, MarkWindow& window) const {
    mark_hits(work.rays.hits, scan_, uncertainty_, window);
    mark_rays(work.rays, limits_.cancel, window);
    check_cancelled();
    window.finish();
  }

  void check_cancelled() const {
    if (limits_.cancel.is_cancelled()) {
      throw CancelledError("the scan was cancelled, the map is as it was before");
    }
  }

  void reserve_memory(const MarkWindow& window) {
    bytes_ += most_bytes_to_insert(window);
    if (bytes_ <= limits_.max_bytes) return;
    const auto mib = [](std::uint64_t bytes) { return std::to_string((bytes >> 20) + 1); };
    throw ScanTooLargeError("scan: inserting it may take " + mib(bytes_) + " MiB or more, " +
                            mib(limits_.max_bytes) +
                            " MiB are left: lower sensor.range_max_m or take a coarser map");
  }

  UncertaintyOcTree& tree_;
  const Scan& scan_;
  const ScanUncertainty& uncertainty_;
  const InsertLimits& limits_;
  InsertResult& result_;
  TileUndo undo_;
  bool is_undone_ = false;
  std::uint64_t bytes_ = 0;  ///< that the windows so far may take at most
};

}  // namespace

InsertResult insert_scan(UncertaintyMap& map, const Scan& scan, const Transform& T_map_sensor,
                         const SensorOptions& sensor, const InsertLimits& limits) {
  sensor.validate();
  if (!scan.colours.empty() && scan.colours.size() != scan.points_m.size()) {
    throw UsageError("scan: " + std::to_string(scan.colours.size()) + " colours for " +
                     std::to_string(scan.points_m.size()) + " points, give one a point or none");
  }
  ScanRays rays = scan_rays(scan, T_map_sensor, sensor, map.lattice());
  refuse_wrong_unit(rays.counts, sensor);
  InsertResult result;
  static_cast<ScanCounts&>(result) = rays.counts;
  result.rays_cleared = rays.cleared;
  result.points_ignored =
      rays.counts.points_too_near + rays.counts.points_not_finite + rays.counts.points_off_lattice;
  const ScanUncertainty uncertainty(scan, T_map_sensor, sensor, map.lattice());
  WindowWriter(detail::MapAccess::tree(map), scan, uncertainty, limits, result)
      .write(scan_windows(std::move(rays)));
  return result;
}

}  // namespace nbvopt
