#include "sim/exploration/view/promises.hpp"

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
    if (part.cube >= doubts_.size()) doubts_.resize(part.cube + 1);
    doubts_[part.cube] = std::max(doubts_[part.cube], part.information);
  }
}

double Promises::believed(const PlaceGain& gain) const {
  double information = 0.0;
  for (const CubeGain& part : gain) information += believed(part);
  return information;
}

}  // namespace nbvopt
