#include "nbvopt/sim/prediction_record.hpp"

#include <cmath>
#include <limits>

namespace nbvopt {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void PredictionRecord::add(double predicted, double realised) {
  ++steps;
  sum_x += predicted;
  sum_y += realised;
  sum_xx += predicted * predicted;
  sum_yy += realised * realised;
  sum_xy += predicted * realised;
}

PredictionRecord& PredictionRecord::operator+=(const PredictionRecord& other) {
  steps += other.steps;
  sum_x += other.sum_x;
  sum_y += other.sum_y;
  sum_xx += other.sum_xx;
  sum_yy += other.sum_yy;
  sum_xy += other.sum_xy;
  return *this;
}

double PredictionRecord::correlation() const {
  const auto n = static_cast<double>(steps);
  const double variance_x = n * sum_xx - sum_x * sum_x;
  const double variance_y = n * sum_yy - sum_y * sum_y;
  if (!(variance_x > 0.0 && variance_y > 0.0)) return kNaN;
  return (n * sum_xy - sum_x * sum_y) / std::sqrt(variance_x * variance_y);
}

double PredictionRecord::slope() const {
  const auto n = static_cast<double>(steps);
  const double variance_x = n * sum_xx - sum_x * sum_x;
  return variance_x > 0.0 ? (n * sum_xy - sum_x * sum_y) / variance_x : kNaN;
}

double PredictionRecord::bias() const { return sum_y > 0.0 ? sum_x / sum_y - 1.0 : kNaN; }

}  // namespace nbvopt
