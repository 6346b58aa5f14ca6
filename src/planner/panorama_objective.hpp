// The panorama over the mast's box, as solvers see it.
#pragma once

#include <memory>
#include <mutex>

#include "nbvopt/gain/panorama.hpp"
#include "planner/joint_objective.hpp"
#include "planner/search_trace.hpp"

namespace nbvopt {

/// G(pan, tilt, height), with its gradient and, per ray, residuals: one a patch of rays,
/// sqrt(w (1 - c_b(q)) + eps), c_b the patch's share of its bound w. Thread-safe.
class PanoramaObjective final : public JointObjective {
 public:
  /// The panorama is made when it is first needed: solvers without surrogates do not pay for it.
  /// `trace` may be null. The arguments but grid and options must outlive the objective.
  PanoramaObjective(std::shared_ptr<const VoxelGrid> grid, const SensorOptions& sensor,
                    const MovingMast& mast, const JointBox& box, const PanoramaOptions& options,
                    const HazardTable& hazards, SearchTrace* trace);

  double value(const Point& x) const override;
  bool has_gradient() const override { return true; }
  double value_and_gradient(const Point& x, Point& gradient) const override;
  bool has_residuals() const override { return sensor().counting == Counting::per_ray; }
  Eigen::Index residual_count() const override { return panorama().patch_count(); }
  double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                             Eigen::MatrixXd* jacobian) const override;

 private:
  const Panorama& panorama() const;
  double noted(const Point& x, double gain) const;

  std::shared_ptr<const VoxelGrid> grid_;
  PanoramaOptions options_;
  HazardTable hazards_;
  SearchTrace* trace_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const Panorama> panorama_;
};

}  // namespace nbvopt
