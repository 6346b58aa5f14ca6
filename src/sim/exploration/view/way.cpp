#include "sim/exploration/view/way.hpp"

#include <vector>

namespace nbvopt {

double information_along(std::span<const PlaceGain* const> places) {
  thread_local std::vector<double> most;  // by cube; all 0 between calls
  double information = 0.0;
  for (const PlaceGain* place : places) {
    for (const CubeGain& gain : *place) {
      if (gain.cube >= most.size()) most.resize(2 * gain.cube + 1);
      double& best = most[gain.cube];
      if (gain.information <= best) continue;
      information += gain.information - best;
      best = gain.information;
    }
  }
  for (const PlaceGain* place : places) {
    for (const CubeGain& gain : *place) most[gain.cube] = 0.0;
  }
  return information;
}

double information_per_s(const Way& way, double look_s) {
  return information_along(way.places) / (way.travel_s + look_s);
}

}  // namespace nbvopt
