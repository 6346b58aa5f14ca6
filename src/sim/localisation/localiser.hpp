// Where the base is along a drive, in truth and as it believes.
#pragma once

#include <cstdint>
#include <memory>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/sim/localisation.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "sim/odometry/position_errors.hpp"

namespace nbvopt {

class Odometry;
class Slam;

/// A base's pose in the map that it draws, and in the world, which its camera sees. The two frames
/// are one where the drive starts, and remain so where the base knows its pose.
struct BasePoses {
  Transform T_map_base;    ///< believed
  Transform T_world_base;  ///< true
};

/// Follows a drive from its start.
class Localiser {
 public:
  /// Throws InputError when slam has nothing to go by. Scene and trajectory must outlive this.
  Localiser(const Scene& scene, const Trajectory& trajectory, const LocalisationOptions& options,
            std::uint64_t seed);
  ~Localiser();

  /// Times must not go back.
  BasePoses at(double time_s);

  /// Where the base will be at a later time, as believed at the latest one that at() was asked for:
  /// it knows how it is going to drive.
  BasePoses ahead(double time_s) const;

  /// What at() was off, and what it cost.
  LocalisationRecord record() const;

 private:
  const Trajectory& trajectory_;
  std::unique_ptr<const Odometry> odometry_;  ///< null where the pose is known
  std::unique_ptr<Slam> slam_;                ///< null but for slam
  BasePoses latest_;
  PositionErrors errors_;
};

}  // namespace nbvopt
