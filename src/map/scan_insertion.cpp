#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "map/map_access.hpp"
#include "map/mark_window.hpp"
#include "map/scan_counting.hpp"
#include "map/scan_rays.hpp"
#include "map/scan_windows.hpp"
#include "map/segment_walk.hpp"
#include "map/tile_update.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

namespace {

void add_hit(const ScanHit& hit, const Scan& scan, MarkWindow& window) {
  HitVoxel& voxel = window.mark_hit(hit.key);
  voxel.uncertainty = std::min(voxel.uncertainty, hit.uncertainty);  // Equation (9)
  if (scan.colours.empty()) return;
  for (int c = 0; c < 3; ++c) voxel.colour_sum[c] += scan.colours[hit.point][c];
  ++voxel.coloured_points;
}

void insert_window(UncertaintyOcTree& tree, const Scan& scan, const WindowWork& work,
                   InsertResult& result) {
  MarkWindow window(work.least, work.tiles);
  for (const Eigen::Vector3d& end : work.rays.ends) {
    window.mark_passed(SegmentWalk(work.rays.origin, end));
  }
  for (const ScanHit& hit : work.rays.hits) add_hit(hit, scan, window);
  window.summarise();
  TileUpdate update(tree, window, result);
  for (std::uint32_t tile = 0; tile < window.tile_count(); ++tile) update.apply(tile);
}

}  // namespace

InsertResult insert_scan(UncertaintyMap& map, const Scan& scan, const Transform& T_map_sensor,
                         const SensorOptions& sensor) {
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
  for (const WindowWork& work : scan_windows(std::move(rays))) {
    insert_window(detail::MapAccess::tree(map), scan, work, result);
  }
  return result;
}

}  // namespace nbvopt
