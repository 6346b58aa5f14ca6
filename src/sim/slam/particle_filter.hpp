// Where a base is and what is around it, from its wheels and its lidar.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "sim/odometry/motion_model.hpp"
#include "sim/plane_scan.hpp"
#include "sim/slam/tile_grid.hpp"

namespace nbvopt {

/// A Rao-Blackwellised particle filter after Grisetti, Stachniss and Burgard (GMapping): each of 30
/// particles is a way that the base may have taken, with the map in the plane that follows from it.
/// The same seed gives the same poses for any number of threads.
class ParticleFilter {
 public:
  /// Begins at a pose that is known, with the scan there.
  ParticleFilter(const MotionModel& model, const PlanarPose& T_map_base,
                 std::span<const PlaneBeam> scan, std::uint64_t seed);

  /// The base has moved so, by the wheels, since the scan before; this is what it sees now.
  void update(const PlanarPose& motion, std::span<const PlaneBeam> scan);

  /// By the particle whose scans were the most likely, over its whole way.
  const PlanarPose& T_map_base() const { return best().T_map_base; }

  /// Where a scan, which is not entered, fits into that particle's map, from a guess.
  PlanarPose fit(const PlanarPose& guess_T_map_base, std::span<const PlaneBeam> scan) const;

 private:
  struct Particle {
    PlanarPose T_map_base;
    double log_weight;      ///< since the latest resampling
    double log_likelihood;  ///< over all scans
    TileGrid grid;
  };

  const Particle& best() const;

  /// Replaces the particles by such as are drawn by their weights, where few of them carry most of
  /// the weight.
  void resample();

  MotionModel model_;
  std::mt19937_64 generator_;
  std::vector<Particle> particles_;
};

}  // namespace nbvopt
