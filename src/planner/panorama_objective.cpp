#include "planner/panorama_objective.hpp"

namespace nbvopt {
namespace {

/// Keeps the roots of the residuals smooth: a share of a patch's bound.
constexpr double kResidualFloor = 1e-6;

}  // namespace

PanoramaObjective::PanoramaObjective(std::shared_ptr<const VoxelGrid> grid,
                                     const SensorOptions& sensor, const MovingMast& mast,
                                     const JointBox& box, const PanoramaOptions& options,
                                     const HazardTable& hazards, SearchTrace* trace)
    : JointObjective(mast, sensor, box),
      grid_(std::move(grid)),
      options_(options),
      hazards_(hazards),
      trace_(trace) {}

double PanoramaObjective::value(const Point& x) const {
  return noted(x, panorama().gain(JointPosition::from(x)));
}

double PanoramaObjective::value_and_gradient(const Point& x, Point& gradient) const {
  Eigen::Vector3d by_joint;
  const double gain = panorama().gain(JointPosition::from(x), by_joint);
  gradient = by_joint;
  return noted(x, gain);
}

double PanoramaObjective::value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                                              Eigen::MatrixXd* jacobian) const {
  Eigen::VectorXd gains;
  panorama().patch_gains(JointPosition::from(x), gains, jacobian);
  const double bound = panorama().patch_gain_bound();
  residuals = ((bound - gains.array()).max(0.0) + kResidualFloor * bound).sqrt();
  if (jacobian) {
    // d sqrt(w - g) = -dg / (2 sqrt(w - g)), and nothing where g is held to the bound.
    const Eigen::ArrayXd is_below = (gains.array() < bound).cast<double>();
    *jacobian = (-0.5 * is_below / residuals.array()).matrix().asDiagonal() * *jacobian;
  }
  return noted(x, gains.sum());
}

const Panorama& PanoramaObjective::panorama() const {
  std::call_once(made_, [this] {
    panorama_ = std::make_unique<Panorama>(grid_, sensor(), mast(),
                                           JointBox{box().lower, box().upper}, options_, hazards_);
  });
  return *panorama_;
}

double PanoramaObjective::noted(const Point& x, double gain) const {
  if (trace_ != nullptr) trace_->record(EvaluationKind::surrogate, JointPosition::from(x), gain);
  return gain;
}

}  // namespace nbvopt
