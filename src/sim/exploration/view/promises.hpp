// Whether driving and looking bring what was promised.
//
// A gain is an estimate. Where a surface is nearer than the camera measures, or a voxel is never
// hit, it promises for ever what no view brings, and a base that trusts it stands there for ever.
#pragma once

#include <algorithm>
#include <vector>

#include "sim/exploration/view/place_panorama.hpp"

namespace nbvopt {

class Promises {
 public:
  /// Promises are judged after so long.
  explicit Promises(double period_s) : period_s_(period_s) {}

  /// From now on so much information is to come a second.
  void promise(double information_per_s) { promised_per_s_ = information_per_s; }

  /// Tells how much information there is by now. Whether a period is over in which less than a
  /// quarter of what was promised has come.
  bool is_broken(double time_s, double information);

  /// What a place promises now is not believed from now on. Cubes are named by small numbers, as
  /// PlaceGains does it.
  void doubt(const PlaceGain& gain);

  /// What is promised of a cube beyond all doubts, at least 0.
  double believed(const CubeGain& gain) const {
    const double doubt = gain.cube < doubts_.size() ? doubts_[gain.cube] : 0.0;
    return std::max(0.0, gain.information - doubt);
  }

  /// The same of a place.
  double believed(const PlaceGain& gain) const;

 private:
  double period_s_;
  double promised_per_s_ = 0.0;
  double time_s_ = 0.0;
  // Of the period.
  double begin_s_ = 0.0;
  double promised_ = 0.0;
  double information_before_ = 0.0;
  std::vector<double> doubts_;  ///< information by cube, none beyond its end
};

}  // namespace nbvopt
