#include "sim/exploration/view/places.hpp"

#include <limits>
#include <map>

namespace nbvopt {
namespace {

/// Edge of the squares. What a camera sees changes little within it, and a door is wider.
constexpr double kSquare_m = 0.5;

struct Candidate {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();
  double from_middle_m = std::numeric_limits<double>::infinity();
};

}  // namespace

Cell square_at(const Eigen::Vector2d& position_map_m) {
  return (position_map_m / kSquare_m).array().floor().cast<int>();
}

std::vector<Place> reachable_places(const DriveCosts& costs, GridPlanner& planner,
                                    const DriveRegion& region) {
  const OccupancyGrid& grid = costs.grid();
  const Eigen::AlignedBox2i& bounds = grid.bounds();
  std::map<Cell, Candidate, SquareOrder> candidates;
  for (int y = bounds.min().y(); y <= bounds.max().y(); ++y) {
    for (int x = bounds.min().x(); x <= bounds.max().x(); ++x) {
      if (!costs.is_passable({x, y}) || !planner.cost_m({x, y})) continue;
      const Eigen::Vector2d position_map_m = grid.centre_map_m({x, y});
      if (!region.contains(position_map_m) || region.is_open_ground(position_map_m)) continue;
      const Cell square = square_at(position_map_m);
      const Eigen::Vector2d middle_m =
          (square.cast<double>() + Eigen::Vector2d::Constant(0.5)) * kSquare_m;
      const double from_middle_m = (position_map_m - middle_m).norm();
      Candidate& nearest = candidates[square];
      if (from_middle_m < nearest.from_middle_m) nearest = {position_map_m, from_middle_m};
    }
  }
  std::vector<Place> places;
  places.reserve(candidates.size());
  for (const auto& [square, nearest] : candidates)
    places.push_back({square, nearest.position_map_m});
  return places;
}

}  // namespace nbvopt
