// What all objectives over the joints of a mast have in common.
#pragma once

#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"
#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// A function of (pan, tilt, height) over a box in reach.
class JointObjective : public Objective {
 public:
  /// `mast` and `sensor` must outlive the objective.
  JointObjective(const MovingMast& mast, const SensorOptions& sensor, const JointBox& box)
      : mast_(mast), sensor_(sensor), box_{box.min, box.max} {}

  const Box& box() const override { return box_; }

  /// The motion, seconds.
  double tie_cost(const Point& x) const override;

  /// One turn of a continuous pan whose box holds all of it.
  double period(Eigen::Index joint) const override;

  /// What moves the rays at the focal distance by one ray: over that length the exact gain has ups
  /// and downs, since rays go from voxel to voxel.
  double length_scale(Eigen::Index joint) const override;

 protected:
  const MovingMast& mast() const { return mast_; }
  const SensorOptions& sensor() const { return sensor_; }

 private:
  const MovingMast& mast_;
  const SensorOptions& sensor_;
  Box box_;
};

}  // namespace nbvopt
