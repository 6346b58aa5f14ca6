#include "solvers/unit_box.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

UnitBox::UnitBox(const Box& box, const Point& start) : box_(box), start_(start) {
  for (Eigen::Index i = 0; i < box.dimension(); ++i) {
    if (box.lower[i] < box.upper[i]) free_.push_back(i);
  }
  width_ = box.upper(free_) - box.lower(free_);
  unit_start_ = ((start(free_) - box.lower(free_)).array() / width_.array()).min(1.0);
}

Point UnitBox::from_unit(const Point& u) const {
  if (u == unit_start_) return start_;  // scaling there and back rounds
  Point x = start_;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Eigen::Index i = free_[k];
    const double unit = std::clamp(u[static_cast<Eigen::Index>(k)], 0.0, 1.0);
    x[i] = std::lerp(box_.lower[i], box_.upper[i], unit);
  }
  return box_.clamp(x);
}

Point UnitBox::unit_scale(const Objective& objective) const {
  Point scale(dimension());
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    scale[i] = std::min(1.0, objective.length_scale(free_[k]) / width_[i]);
  }
  return scale;
}

Point UnitBox::unit_gradient(const Point& gradient) const {
  return gradient(free_).cwiseProduct(width_);
}

Eigen::MatrixXd UnitBox::unit_jacobian(const Eigen::MatrixXd& jacobian) const {
  return jacobian(Eigen::all, free_) * width_.asDiagonal();
}

double checked_tolerance(double tolerance) {
  if (std::isfinite(tolerance) && tolerance > 0.0) return tolerance;
  std::ostringstream text;
  text << "tolerance = " << tolerance << ": give a finite number of length scales above 0";
  throw UsageError(text.str());
}

}  // namespace nbvopt
