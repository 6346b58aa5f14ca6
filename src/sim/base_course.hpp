// The base's course through an episode, which may be settled only while the episode runs.
#pragma once

#include <memory>

#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sim/trajectory.hpp"

namespace nbvopt {

/// What an episode has learnt so far.
struct EpisodeKnowledge {
  std::shared_ptr<const VoxelGrid> grid;  ///< of the map; null where the mode does not plan
  HazardTable hazards = HazardTable();
  double information = 0.0;  ///< in the map, Eq. 11
};

class BaseCourse {
 public:
  virtual ~BaseCourse() = default;

  /// Settles the course up to this time, or to its end. Times rise from call to call.
  virtual void settle(double time_s, const EpisodeKnowledge& known) = 0;

  /// All that is settled, at least where the base starts: always the same object, which grows.
  virtual const Trajectory& trajectory() const = 0;
};

/// A drive that was recorded.
class RecordedCourse final : public BaseCourse {
 public:
  /// The trajectory must outlive it.
  explicit RecordedCourse(const Trajectory& trajectory) : trajectory_(trajectory) {}

  void settle(double /*time_s*/, const EpisodeKnowledge& /*known*/) override {}
  const Trajectory& trajectory() const override { return trajectory_; }

 private:
  const Trajectory& trajectory_;
};

}  // namespace nbvopt
