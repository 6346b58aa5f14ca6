// How well predicted gains meet those that the next captures realise.
#pragma once

#include <cstdint>

namespace nbvopt {

/// Sums over pairs of a predicted (x) and a realised (y) gain.
struct PredictionRecord {
  std::uint64_t steps = 0;
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_xx = 0.0;
  double sum_yy = 0.0;
  double sum_xy = 0.0;

  void add(double predicted, double realised);

  /// Pools the steps of another episode with these.
  PredictionRecord& operator+=(const PredictionRecord& other);

  /// Pearson's; NaN where predictions or realised gains do not vary, or there are less than two.
  double correlation() const;

  /// Of the line that fits realised gains best, by least squares over the predicted ones: below 1
  /// where high predictions are too high by more than low ones. NaN where they do not vary.
  double slope() const;

  /// By how much predictions are too high, as a share of what was realised; NaN where that is 0.
  double bias() const;
};

}  // namespace nbvopt
