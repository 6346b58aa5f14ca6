// A scan as rays and hits on a map's lattice.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "map/ray_ends.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// A return within range, and the voxel that holds it.
struct ScanHit {
  VoxelKey key;
  std::uint32_t point = 0;  ///< its index in the scan
};

/// In lattice coordinates, where voxel k spans [k, k + 1).
struct ScanRays {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  RayEnds ends;  ///< of returns and of rays that are clear up to D_max
  std::vector<ScanHit> hits;
  std::uint64_t cleared = 0;
  ScanCounts counts;
};

/// Sorts the scan's points and directions into rays and hits, as insert_scan() says.
ScanRays scan_rays(const Scan& scan, const Transform& T_map_sensor, const SensorOptions& sensor,
                   const Lattice& lattice);

}  // namespace nbvopt
