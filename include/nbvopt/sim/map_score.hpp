// How much of a map is true.
#pragma once

#include <cstdint>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// A map against the world that it is of. An occupied voxel is true when a surface of the world
/// comes within a voxel's edge of its centre.
struct MapScore {
  std::uint64_t occupied_voxels = 0;
  double precision = 1.0;  ///< the share of occupied voxels that are true
  /// The share of the voxels that the same views occupy when they are entered from where they were
  /// truly taken, for which the map has an occupied voxel there or beside one of its faces.
  double recall = 1.0;
  /// Eq. 11 over the true voxels alone. A surface that is drawn twice within a voxel's edge counts
  /// twice.
  double true_information = 0.0;
  /// Eq. 11 over the voxels that the same views occupy from where they were truly taken: each part
  /// of a surface at most once.
  double shared_information = 0.0;
};

/// The score of a map; `of_true_poses` is the map that the same
/// views draw from where they were truly taken, which may be the map itself.
MapScore score_map(const UncertaintyMap& map, const UncertaintyMap& of_true_poses,
                   const Scene& scene);

}  // namespace nbvopt
