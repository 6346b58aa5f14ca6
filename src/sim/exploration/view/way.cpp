#include "sim/exploration/view/way.hpp"

#include <unordered_map>

namespace nbvopt {

double information_along(std::span<const PlaceGain* const> places) {
  thread_local std::unordered_map<std::uint64_t, double> most;  // by cube; only looked up
  most.clear();
  double information = 0.0;
  for (const PlaceGain* place : places) {
    for (const CubeGain& gain : *place) {
      double& best = most[gain.cube];
      if (gain.information <= best) continue;
      information += gain.information - best;
      best = gain.information;
    }
  }
  return information;
}

double information_per_s(const Way& way, double look_s) {
  return information_along(way.places) / (way.travel_s + look_s);
}

}  // namespace nbvopt
