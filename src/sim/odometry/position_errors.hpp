// Position errors, added up.
#pragma once

#include <algorithm>
#include <cstdint>

#include "nbvopt/sim/localisation.hpp"

namespace nbvopt {

/// Takes errors one by one.
class PositionErrors {
 public:
  void add(double error_m) {
    sum_m_ += error_m;
    summary_.mean_m = sum_m_ / static_cast<double>(++count_);
    summary_.largest_m = std::max(summary_.largest_m, error_m);
    summary_.end_m = error_m;
  }
  const PositionError& summary() const { return summary_; }

 private:
  std::uint64_t count_ = 0;
  double sum_m_ = 0.0;
  PositionError summary_;
};

}  // namespace nbvopt
