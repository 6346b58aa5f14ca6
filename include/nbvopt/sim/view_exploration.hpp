// A robot that chooses where to drive by what its camera would see there.
#pragma once

#include <functional>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/exploration.hpp"

namespace nbvopt {

struct ViewExplorationOptions {
  ExplorationOptions drive;
  EpisodeOptions episode;     ///< how the camera maps, computing never charged and the pose known
  double resolution_m = 0.1;  ///< of the map's voxels
  double information_min_per_s = 10.0;  ///< the exploration ends where no way brings more

  /// Throws InputError that names the first bad value.
  void validate() const;
};

/// A drive, and the map that the camera made along it.
struct ViewExploration {
  Exploration exploration;
  UncertaintyMap map;
  EpisodeSummary summary;
};

/// Explores with base and camera together: at each t the camera looks where the mode "auto" says,
/// and the base drives to the place where the map, and what is likely of the unknown, promise most
/// information a second of driving and looking. An episode with the same options and that mode,
/// along the trajectory, makes the same map. The same options give the same drive, for any number
/// of threads. `observe` is called after each capture. Throws InputError as explore() and
/// run_episode() do.
ViewExploration explore_views(
    const Scene& scene, const Transform& T_map_base, const ViewExplorationOptions& options,
    const std::function<void(const Capture&)>& observe = [](const Capture&) {});

}  // namespace nbvopt
