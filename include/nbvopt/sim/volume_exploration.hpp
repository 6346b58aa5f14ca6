// Exploration by what a camera would see in space: the 3D baseline of the paper.
#pragma once

#include "nbvopt/core/transform.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// S. Bai, J. Wang, F. Chen, B. Englot, "Information-theoretic exploration with Bayesian
/// optimization", IROS 2016, in two forms.
enum class VolumeExplorer {
  bai2016,   ///< as published
  tekniker,  ///< as the paper's authors ran their changed copy, its faults included
};

/// Explores by a map in space of its own, an octree of 0.05 m into which the explorer's own camera
/// looks once a second: its frontiers are those of a slice, its goals the poses near them from
/// which the most of the unknown would be seen, by a Gaussian process that learns from few poses
/// what the others would show. The camera stands still on the base; base, lidar and plane map are
/// those of explore(), and so are options, errors and promises: `seed` decides which poses are
/// tried. `complete` where no more than three (two) poses are left, which may never be.
Exploration explore_volume(const Scene& scene, const Transform& T_map_base,
                           const Transform& T_base_sensor, VolumeExplorer explorer,
                           const ExplorationOptions& options);

/// The same from where explore() ends, with the maps of plane and space that its drive has made:
/// what the paper proposes last. Both drives are one trajectory, and share `duration_max_s`.
Exploration explore_volume_after_plane(const Scene& scene, const Transform& T_map_base,
                                       const Transform& T_base_sensor, VolumeExplorer explorer,
                                       const ExplorationOptions& options);

}  // namespace nbvopt
