#include "sim/exploration/frontier_filter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace nbvopt {
namespace {

/// One frontier stands for all within this distance.
constexpr double kNeighbourhood_m = 0.5;
/// Less unknown area than this is not worth a way: gaps between beams, the shadow of a chair's leg.
constexpr double kLeastUnknown_square_m = 0.2;

bool is_near(std::span<const Eigen::Vector2d> points, const Eigen::Vector2d& position) {
  return std::ranges::any_of(points, [&](const Eigen::Vector2d& point) {
    return (point - position).norm() < kNeighbourhood_m;
  });
}

}  // namespace

double unknown_area_m2(const OccupancyGrid& grid, const Eigen::Vector2d& position_map_m) {
  static const std::array<Cell, 4> neighbours{Cell(1, 0), Cell(0, 1), Cell(-1, 0), Cell(0, -1)};
  const int radius = static_cast<int>(kInformationRadius_m / grid.cell_m());
  const int width = 2 * radius + 1;
  std::vector<char> is_seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(width));
  const auto seen = [&](const Cell& offset) -> char& {
    return is_seen[static_cast<std::size_t>((offset.y() + radius) * width + offset.x() + radius)];
  };
  const Cell centre = grid.cell_at(position_map_m);
  std::vector<Cell> front{Cell::Zero()};  // as offsets from the centre
  seen(front.front()) = true;
  std::size_t unknown = 0;
  while (!front.empty()) {
    const Cell offset = front.back();
    front.pop_back();
    if (grid.state(centre + offset) == CellState::unknown) ++unknown;
    for (const Cell& neighbour : neighbours) {
      const Cell next = offset + neighbour;
      if (next.squaredNorm() > radius * radius || seen(next)) continue;
      seen(next) = true;
      if (grid.state(centre + next) != CellState::occupied) front.push_back(next);
    }
  }
  return static_cast<double>(unknown) * grid.cell_m() * grid.cell_m();
}

bool is_worth_a_way(double unknown_m2) { return unknown_m2 >= kLeastUnknown_square_m; }

void FrontierFilter::add(const OccupancyGrid& grid, std::span<const Eigen::Vector2d> points_map_m) {
  for (const Eigen::Vector2d& point : points_map_m) {
    const bool is_stood_for = std::ranges::any_of(frontiers_, [&](const Frontier& frontier) {
      return (frontier.position_map_m - point).norm() < kNeighbourhood_m;
    });
    if (is_stood_for || is_near(given_up_map_m_, point) || is_near(aside_map_m_, point)) continue;
    const double unknown_m2 = unknown_area_m2(grid, point);
    if (is_worth_a_way(unknown_m2)) frontiers_.push_back({point, unknown_m2});
  }
}

void FrontierFilter::update(const OccupancyGrid& grid) {
  for (Frontier& frontier : frontiers_) {
    frontier.unknown_m2 = unknown_area_m2(grid, frontier.position_map_m);
  }
  std::erase_if(frontiers_,
                [](const Frontier& frontier) { return !is_worth_a_way(frontier.unknown_m2); });
}

void FrontierFilter::give_up(const Eigen::Vector2d& position_map_m) {
  drop(position_map_m);
  given_up_map_m_.push_back(position_map_m);
}

void FrontierFilter::set_aside(const Eigen::Vector2d& position_map_m) {
  drop(position_map_m);
  aside_map_m_.push_back(position_map_m);
}

void FrontierFilter::drop(const Eigen::Vector2d& position_map_m) {
  std::erase_if(frontiers_, [&](const Frontier& frontier) {
    return frontier.position_map_m == position_map_m;
  });
}

}  // namespace nbvopt
