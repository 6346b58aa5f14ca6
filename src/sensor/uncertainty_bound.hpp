// A quick lower bound of a point's uncertainty.
#pragma once

#include <Eigen/Core>

#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {

/// A bound of UncertaintyModel::uncertainty(), normals or not, from below. Without normals it is
/// mostly less than 1e-3 under it, in a fifth of the time: it takes no decision and calls nothing.
class UncertaintyBound {
 public:
  explicit UncertaintyBound(const UncertaintyModel& model)
      : focal_distance_m_(static_cast<float>(model.focal_distance_m())),
        distance_weight_(static_cast<float>(model.distance_weight())),
        most_of_an_angle_(static_cast<float>(model.angle_weight() / 2.0)),
        horizontal_weight_per_rad_(static_cast<float>(model.horizontal_weight_per_rad())),
        vertical_weight_per_rad_(static_cast<float>(model.vertical_weight_per_rad())),
        margin_(1e-5F + 1e-6F * focal_distance_m_ +
                2e-5F * (horizontal_weight_per_rad_ + vertical_weight_per_rad_)) {}

  /// Of many points at once: Eigen's arrays of one coordinate each, in the sensor frame, metres.
  template <class Coordinates>
  Coordinates operator()(const Coordinates& x, const Coordinates& y, const Coordinates& z) const {
    const Coordinates d_focal_m = ((x * x + y * y + z * z).sqrt() - focal_distance_m_).abs();
    const Coordinates ahead = z.max(1e-20F);  // what is behind the camera counts as beside it
    return distance_weight_ * least_tanh<Coordinates>(0.5F * d_focal_m) +
           (horizontal_weight_per_rad_ * angle_rad<Coordinates>(x.abs(), ahead))
               .min(most_of_an_angle_) +
           (vertical_weight_per_rad_ * angle_rad<Coordinates>(y.abs(), ahead))
               .min(most_of_an_angle_) -
           margin_;
  }

 private:
  /// At most tanh(y), which is Equation (2) of 2 y, for y >= 0: a convergent of its continued
  /// fraction, off by 2e-5 at y = 3, beyond which it stays what it is there.
  template <class Numbers>
  static Numbers least_tanh(const Numbers& y) {
    const Numbers t = y.min(3.0F);
    const Numbers s = t * t;
    return t * (10395.0F + s * (1260.0F + s * 21.0F)) /
           (10395.0F + s * (4725.0F + s * (210.0F + s)));
  }

  /// The angle of (ahead, across), both of which are positive. The polynomial is Abramowitz and
  /// Stegun's 4.4.49, off from atan by 1.2e-5 at most.
  template <class Numbers>
  static Numbers angle_rad(const Numbers& across, const Numbers& ahead) {
    constexpr float kEighthTurn_rad = 0.785398163F;
    const Numbers t = (across - ahead) / (across + ahead);
    const Numbers s = t * t;
    return kEighthTurn_rad +
           t * (0.9998660F +
                s * (-0.3302995F + s * (0.1801410F + s * (-0.0851330F + s * 0.0208351F))));
  }

  float focal_distance_m_;
  float distance_weight_;
  float most_of_an_angle_;  ///< what it adds at the edge of the field of view and beyond
  float horizontal_weight_per_rad_;
  float vertical_weight_per_rad_;
  float margin_;  ///< of rounding, and of the polynomial
};

}  // namespace nbvopt
