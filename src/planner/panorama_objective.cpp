#include "planner/panorama_objective.hpp"

#include <algorithm>
#include <cmath>

#include "planner/joint_period.hpp"

namespace nbvopt {
namespace {

/// The coarse panorama decides where to climb, not where the top is.
constexpr PanoramaOptions kCoarse{.ray_spacing = 2.0, .layer_spacing = 2.0};
constexpr PanoramaOptions kFine{};

/// Keeps the root of a residual smooth: a share of the patch's bound.
constexpr double kResidualFloor = 1e-6;

}  // namespace

PanoramaObjective::PanoramaObjective(const MovingMast& mast, const JointBox& box, Counting counting,
                                     MakePanorama make_panorama,
                                     std::unique_ptr<const Objective> coarser, SearchTrace* trace)
    : mast_(mast),
      box_{box.min, box.max},
      counting_(counting),
      make_panorama_(std::move(make_panorama)),
      coarser_(std::move(coarser)),
      trace_(trace) {}

double PanoramaObjective::value(const Point& x) const {
  return noted(x, panorama().gain(JointPosition::from(x)));
}

double PanoramaObjective::tie_cost(const Point& x) const {
  return mast_.arrival_time_s(JointPosition::from(x));
}

double PanoramaObjective::period(Eigen::Index coordinate) const {
  return joint_period(mast_.mast(), box_, coordinate);
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
  residuals = (bound - gains.array()).max(0.0) + kResidualFloor * bound;
  residuals = residuals.cwiseSqrt();
  // d sqrt(w - g) = -dg / (2 sqrt(w - g)).
  if (jacobian) *jacobian = (-0.5 * residuals.cwiseInverse()).asDiagonal() * *jacobian;
  return noted(x, gains.sum());
}

const Panorama& PanoramaObjective::panorama() const {
  std::call_once(made_, [this] { panorama_ = make_panorama_(); });
  return *panorama_;
}

double PanoramaObjective::noted(const Point& x, double gain) const {
  if (trace_ != nullptr) trace_->record(EvaluationKind::surrogate, JointPosition::from(x), gain);
  return gain;
}

std::unique_ptr<const Objective> make_surrogates(std::shared_ptr<const VoxelGrid> grid,
                                                 const SensorOptions& sensor,
                                                 const MovingMast& mast, const JointBox& box,
                                                 SearchTrace* trace) {
  const auto of = [&](const PanoramaOptions& options, std::unique_ptr<const Objective> coarser) {
    return std::make_unique<PanoramaObjective>(
        mast, box, sensor.counting,
        [grid, &sensor, &mast, box, options] {
          return std::make_unique<Panorama>(grid, sensor, mast, box, options);
        },
        std::move(coarser), trace);
  };
  return of(kFine, of(kCoarse, nullptr));
}

}  // namespace nbvopt
