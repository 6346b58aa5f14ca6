#include "sim/exploration/view/promises.hpp"

#include <algorithm>

namespace nbvopt {

bool Promises::is_broken(double time_s, double information) {
  constexpr double kKept = 0.25;
  promised_ += promised_per_s_ * (time_s - time_s_);
  time_s_ = time_s;
  if (time_s < begin_s_ + period_s_) return false;
  const bool is_broken = information - information_before_ < kKept * promised_;
  begin_s_ = time_s;
  promised_ = 0.0;
  information_before_ = information;
  return is_broken;
}

void Promises::doubt(const PlaceGain& gain) {
  for (const CubeGain& part : gain) {
    double& doubt = doubts_[part.cube];
    doubt = std::max(doubt, part.information);
  }
}

PlaceGain Promises::believed(const PlaceGain& gain) const {
  if (doubts_.empty()) return gain;
  PlaceGain believed;
  believed.reserve(gain.size());
  for (const CubeGain& part : gain) {
    const auto doubt = doubts_.find(part.cube);
    const double information = part.information - (doubt == doubts_.end() ? 0.0 : doubt->second);
    if (information > 0.0) believed.push_back({part.cube, information});
  }
  return believed;
}

}  // namespace nbvopt
