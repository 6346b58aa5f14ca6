#include "sim/exploration/view/way_information.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "sim/exploration/view/places.hpp"

namespace nbvopt {
namespace {

/// How far apart a way's places are asked for.
constexpr double kStep_m = 0.25;

/// Weighs ways one after another, each from where it leaves the one before.
class WayWeigher {
 public:
  WayWeigher(const CellArray<const PlaceGain*>& places, const Promises& promises)
      : places_(places), promises_(promises) {}

  double information_along(const Path& way);

 private:
  /// A corner of the way that was weighed last, and what was known there.
  struct Corner {
    Eigen::Vector2d position_map_m;
    double next_m;            ///< along the way, where places are asked for next
    double information;       ///< of the way to here
    std::size_t overwritten;  ///< how much was by here
  };
  struct Overwritten {
    std::uint64_t cube;
    double information;
  };

  const PlaceGain* place_at(const Eigen::Vector2d& position_map_m) const;
  void go_back_to(std::size_t corners);
  void add(const PlaceGain& gain, double& information);
  double& most(std::uint64_t cube);

  const CellArray<const PlaceGain*>& places_;
  const Promises& promises_;
  std::vector<Corner> corners_;
  std::vector<double> most_;  ///< by cube, along the way that was weighed last
  std::vector<Overwritten> overwritten_;
};

double WayWeigher::information_along(const Path& way) {
  const std::span<const Eigen::Vector2d> points_map_m = way.points_map_m();
  std::size_t shared = 0;
  while (shared < corners_.size() && shared < points_map_m.size() &&
         corners_[shared].position_map_m == points_map_m[shared]) {
    ++shared;
  }
  go_back_to(shared);
  if (shared == 0) corners_.push_back({points_map_m[0], 0.0, 0.0, 0});
  while (corners_.size() < points_map_m.size()) {
    Corner corner = corners_.back();
    const PlaceGain* passed = nullptr;
    for (; corner.next_m < way.along_m()[corners_.size()]; corner.next_m += kStep_m) {
      const PlaceGain* place = place_at(way.point_at(corner.next_m));
      if (place && place != passed) add(*place, corner.information);
      passed = place;
    }
    corner.position_map_m = points_map_m[corners_.size()];
    corner.overwritten = overwritten_.size();
    corners_.push_back(corner);
  }
  double information = corners_.back().information;
  if (const PlaceGain* goal = place_at(points_map_m.back())) add(*goal, information);
  return information;
}

const PlaceGain* WayWeigher::place_at(const Eigen::Vector2d& position_map_m) const {
  return places_.at(square_at(position_map_m));
}

void WayWeigher::go_back_to(std::size_t corners) {
  corners_.resize(corners);
  const std::size_t kept = corners_.empty() ? 0 : corners_.back().overwritten;
  for (; overwritten_.size() > kept; overwritten_.pop_back()) {
    most_[overwritten_.back().cube] = overwritten_.back().information;
  }
}

void WayWeigher::add(const PlaceGain& gain, double& information) {
  for (const CubeGain& part : gain) {
    const double believed = promises_.believed(part);
    double& best = most(part.cube);
    if (believed <= best) continue;
    overwritten_.push_back({part.cube, best});
    information += believed - best;
    best = believed;
  }
}

double& WayWeigher::most(std::uint64_t cube) {
  if (cube >= most_.size()) most_.resize(2 * cube + 1);
  return most_[cube];
}

/// Whether a way comes before another: those that begin alike stand together.
bool comes_before(const Path& a, const Path& b) {
  return std::ranges::lexicographical_compare(
      a.points_map_m(), b.points_map_m(), [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
        return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
      });
}

}  // namespace

std::vector<double> information_along(std::span<const Path> ways,
                                      const CellArray<const PlaceGain*>& places,
                                      const Promises& promises) {
  std::vector<std::size_t> order(ways.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order,
                    [&](std::size_t a, std::size_t b) { return comes_before(ways[a], ways[b]); });
  WayWeigher weigher(places, promises);
  std::vector<double> information(ways.size());
  for (const std::size_t way : order) information[way] = weigher.information_along(ways[way]);
  return information;
}

}  // namespace nbvopt
