// The panorama over the mast's box, as solvers see it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/solver/objective.hpp"
#include "planner/search_trace.hpp"

namespace nbvopt {

/// G(pan, tilt, height), smooth, with gradient and, per ray, residuals: one a patch of rays,
/// sqrt(w (1 - c_b(q)) + eps), c_b the patch's gain over its bound w. Thread-safe.
class PanoramaObjective final : public Objective {
 public:
  /// The panorama is made when it is first needed: solvers without surrogates never pay for it.
  using MakePanorama = std::function<std::unique_ptr<const Panorama>()>;

  /// All references must outlive the objective; `coarser` and `trace` may be null.
  PanoramaObjective(const MovingMast& mast, const JointBox& box, Counting counting,
                    MakePanorama make_panorama, std::unique_ptr<const Objective> coarser,
                    SearchTrace* trace);

  const Box& box() const override { return box_; }
  double value(const Point& x) const override;
  double tie_cost(const Point& x) const override;
  double period(Eigen::Index coordinate) const override;
  const Objective* surrogate() const override { return coarser_.get(); }
  bool has_gradient() const override { return true; }
  double value_and_gradient(const Point& x, Point& gradient) const override;
  bool has_residuals() const override { return counting_ == Counting::per_ray; }
  Eigen::Index residual_count() const override { return panorama().patch_count(); }
  double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                             Eigen::MatrixXd* jacobian) const override;

 private:
  const Panorama& panorama() const;
  double noted(const Point& x, double gain) const;

  const MovingMast& mast_;
  Box box_;
  Counting counting_;
  MakePanorama make_panorama_;
  std::unique_ptr<const Objective> coarser_;
  SearchTrace* trace_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const Panorama> panorama_;
};

/// The surrogates of the exact gain: a panorama at the sensor's ray spacing, whose own surrogate is
/// a coarser one. The arguments but the grid must outlive them.
std::unique_ptr<const Objective> make_surrogates(std::shared_ptr<const VoxelGrid> grid,
                                                 const SensorOptions& sensor,
                                                 const MovingMast& mast, const JointBox& box,
                                                 SearchTrace* trace);

}  // namespace nbvopt
