#include <algorithm>
#include <array>
#include <cstdint>

#include "map/mark_window.hpp"
#include "map/scan_rays.hpp"
#include "map/scan_windows.hpp"
#include "map/segment_walk.hpp"
#include "map/tile_update.hpp"
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

void insert_window(UncertaintyOcTree& tree, const Scan& scan, const ScanRays& rays,
                   const WindowWork& work, std::vector<VoxelChange>& changes) {
  MarkWindow window(work.least, work.tiles);
  for (const std::uint32_t ray : work.rays) {
    window.mark_passed(SegmentWalk(rays.origin, rays.ends[ray]));
  }
  for (const std::uint32_t hit : work.hits) add_hit(rays.hits[hit], scan, window);
  window.summarise();
  TileUpdate update(tree, window, changes);
  for (std::uint32_t tile = 0; tile < window.tile_count(); ++tile) update.apply(tile);
}

}  // namespace

InsertResult insert_scan(UncertaintyMap& map, const Scan& scan, const Transform& T_map_sensor,
                         const SensorOptions& sensor) {
  const ScanRays rays = scan_rays(scan, T_map_sensor, sensor, map.lattice());
  InsertResult result;
  result.points_used = rays.hits.size();
  result.rays_cleared = rays.cleared;
  result.points_ignored = rays.ignored;
  for (const WindowWork& work : scan_windows(rays)) {
    insert_window(map.tree(), scan, rays, work, result.changes);
  }
  return result;
}

}  // namespace nbvopt
