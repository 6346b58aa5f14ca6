#include "sim/exploration/grid_planner.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace nbvopt {
namespace {

struct Step {
  int x, y;
  double length_cells;
};
/// Straight ones first, then each diagonal one.
constexpr std::array<Step, 8> kSteps{{{1, 0, 1.0},
                                      {0, 1, 1.0},
                                      {-1, 0, 1.0},
                                      {0, -1, 1.0},
                                      {1, 1, std::numbers::sqrt2},
                                      {-1, 1, std::numbers::sqrt2},
                                      {-1, -1, std::numbers::sqrt2},
                                      {1, -1, std::numbers::sqrt2}}};
constexpr int kStraightSteps = 4;

constexpr int kUnknown = -1;

Cell offset(int step) {
  const Step& s = kSteps[static_cast<std::size_t>(step)];
  return {s.x, s.y};
}

}  // namespace

GridPlanner::GridPlanner(const DriveCosts& costs, const Eigen::Vector2d& start_map_m,
                         const Eigen::AlignedBox2i& box)
    : costs_(costs), start_map_m_(start_map_m), box_(box) {
  const Cell size = box.sizes() + Cell::Ones();
  nodes_.assign(static_cast<std::size_t>(size.x()) * static_cast<std::size_t>(size.y()),
                {std::numeric_limits<float>::infinity(), 0, false, Passable::not_asked});
  start_ = number(costs.grid().cell_at(start_map_m));
  nodes_[static_cast<std::size_t>(start_)].cost_m = 0.0F;
  front_.emplace(0.0F, start_);
}

int GridPlanner::number(const Cell& cell) const {
  const Cell offset = cell - box_.min();
  return offset.y() * (box_.sizes().x() + 1) + offset.x();
}

Cell GridPlanner::cell(int number) const {
  const int width = box_.sizes().x() + 1;
  return box_.min() + Cell(number % width, number / width);
}

Eigen::Vector2d GridPlanner::point_map_m(int number) const {
  return number == start_ ? start_map_m_ : costs_.grid().centre_map_m(cell(number));
}

int GridPlanner::before(int number) const {
  return this->number(cell(number) - offset(nodes_[static_cast<std::size_t>(number)].came_by));
}

std::optional<double> GridPlanner::cost_m(const Cell& goal) {
  if (!box_.contains(goal)) return std::nullopt;
  const Node& node = nodes_[static_cast<std::size_t>(number(goal))];
  while (!node.is_settled && !front_.empty()) {
    const auto [cost_m, next] = front_.top();
    front_.pop();
    if (!nodes_[static_cast<std::size_t>(next)].is_settled) spread(next);
  }
  if (!node.is_settled) return std::nullopt;
  return node.cost_m;
}

void GridPlanner::spread(int from) {
  nodes_[static_cast<std::size_t>(from)].is_settled = true;
  const Cell here = cell(from);
  // Off the open cells only straight steps lead out; a diagonal one must have room on both sides.
  std::array<bool, kStraightSteps> is_open{};
  const bool is_passable = this->is_passable(from, here);
  for (int step = 0; step < kStraightSteps; ++step) {
    const Cell next = here + offset(step);
    if (!box_.contains(next)) continue;
    if (!(is_passable ? this->is_passable(number(next), next) : costs_.can_step(here, next))) {
      continue;
    }
    is_open[static_cast<std::size_t>(step)] = is_passable;
    relax(from, step, next);
  }
  for (int step = kStraightSteps; step < static_cast<int>(kSteps.size()); ++step) {
    const auto side = static_cast<std::size_t>(step - kStraightSteps);
    if (!is_open[side] || !is_open[(side + 1) % kStraightSteps]) continue;
    const Cell next = here + offset(step);
    if (this->is_passable(number(next), next)) relax(from, step, next);
  }
}

bool GridPlanner::is_passable(int number, const Cell& cell) {
  Passable& passable = nodes_[static_cast<std::size_t>(number)].passable;
  if (passable == Passable::not_asked) {
    passable = costs_.is_passable(cell) ? Passable::yes : Passable::no;
  }
  return passable == Passable::yes;
}

void GridPlanner::relax(int from, int step, const Cell& next) {
  const int to = number(next);
  Node& node = nodes_[static_cast<std::size_t>(to)];
  if (node.is_settled) return;
  const double length_m =
      kSteps[static_cast<std::size_t>(step)].length_cells * costs_.grid().cell_m();
  const auto cost_m = static_cast<float>(nodes_[static_cast<std::size_t>(from)].cost_m +
                                         length_m * costs_.weight(next));
  if (cost_m >= node.cost_m) return;
  node.cost_m = cost_m;
  node.came_by = static_cast<std::int8_t>(step);
  front_.emplace(cost_m, to);
}

std::optional<Path> GridPlanner::path(const Eigen::Vector2d& goal_map_m) {
  const Cell goal = costs_.grid().cell_at(goal_map_m);
  if (!cost_m(goal)) return std::nullopt;
  std::vector<Eigen::Vector2d> points{goal_map_m};
  if (const int last = number(goal); last != start_) {
    for (int at = corner_before(last, goal_map_m); at != start_; at = corner_before(at)) {
      points.push_back(point_map_m(at));
    }
    points.push_back(start_map_m_);
  }
  std::ranges::reverse(points);
  return Path(std::move(points));
}

int GridPlanner::corner_before(int number) {
  corners_.resize(nodes_.size(), kUnknown);
  std::vector<int> unknown;
  for (int at = number; corners_[static_cast<std::size_t>(at)] == kUnknown && at != start_;) {
    unknown.push_back(at);
    at = before(at);
  }
  for (; !unknown.empty(); unknown.pop_back()) {
    const int at = unknown.back();
    corners_[static_cast<std::size_t>(at)] = corner_before(at, point_map_m(at));
  }
  return corners_[static_cast<std::size_t>(number)];
}

int GridPlanner::corner_before(int number, const Eigen::Vector2d& point_map_m) {
  // A straight piece may cost a cell more than the steps that it replaces: fewer corners are worth
  // it, and start and goal are not in the middle of their cells.
  const double bonus_m = costs_.grid().cell_m();
  const int previous = before(number);
  if (previous == start_) return start_;
  const int corner = corner_before(previous);
  const auto cost_m = [&](int node) {
    return double{nodes_[static_cast<std::size_t>(node)].cost_m};
  };
  const bool is_straight = costs_.line_cost_m(this->point_map_m(corner), point_map_m) <=
                           cost_m(number) - cost_m(corner) + bonus_m;
  return is_straight ? corner : previous;
}

}  // namespace nbvopt
