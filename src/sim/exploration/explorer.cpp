#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/enum_names.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/frontier_filter.hpp"
#include "sim/exploration/frontier_trees.hpp"
#include "sim/exploration/goal_assignment.hpp"
#include "sim/exploration/plane_explorer.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<ExplorationStatus> = std::to_array<EnumName<ExplorationStatus>>({
    {ExplorationStatus::complete, "complete"},
    {ExplorationStatus::open_ground, "open_ground"},
    {ExplorationStatus::time_limit, "time_limit"},
});

namespace {

/// How many scans the robot waits for its trees to find a frontier before it looks everywhere.
constexpr int kPatience = 15;

class Explorer {
 public:
  Explorer(PlaneRobot& robot, const ExplorationOptions& options,
           const std::function<void()>& on_scan)
      : region_(options),
        robot_(robot),
        on_scan_(on_scan),
        costs_(robot_.drive_costs(/*through_unknown=*/false)),
        trees_(robot_.position_map_m(), options.seed) {}

  ExplorationStatus run() {
    ExplorationStatus status = ExplorationStatus::time_limit;
    while (!robot_.is_out_of_time()) {
      find_frontiers();
      if (needs_goal()) choose_goal();
      if (is_done()) {
        status = leaves_open_ground_ ? ExplorationStatus::open_ground : ExplorationStatus::complete;
        break;
      }
      robot_.drive_to_next_scan();
      on_scan_();
    }
    robot_.stop();
    return status;
  }

 private:
  void find_frontiers() { add_frontiers(trees_.grow(robot_.grid(), robot_.position_map_m())); }

  void add_frontiers(std::vector<Eigen::Vector2d> points_map_m) {
    std::erase_if(points_map_m, [&](const Eigen::Vector2d& point) {
      return !region_.contains(point) || region_.is_open_ground(point);
    });
    frontiers_.add(robot_.grid(), points_map_m);
  }

  bool needs_goal() {
    if (!goal_frontier_map_m_) return true;
    if (!is_worth_a_way(unknown_area_m2(robot_.grid(), *goal_frontier_map_m_))) return true;
    if (robot_.has_arrived()) {
      frontiers_.give_up(*goal_frontier_map_m_);
      return true;
    }
    return robot_.is_path_blocked(costs_);
  }

  void choose_goal() {
    goal_frontier_map_m_.reset();
    robot_.halt();
    frontiers_.update(robot_.grid());
    if (frontiers_.frontiers().empty()) return;
    Assignment assignment = assign_goal(costs_, frontiers_.frontiers(), robot_.position_map_m());
    for (const Eigen::Vector2d& position : assignment.unreachable_map_m) {
      frontiers_.set_aside(position);
    }
    if (!assignment.goal) return;
    goal_frontier_map_m_ = assignment.goal->frontier_map_m;
    robot_.follow(std::move(assignment.goal->path));
  }

  /// Trees find frontiers by chance; the end is certain.
  bool is_done() {
    idle_scans_ = goal_frontier_map_m_ ? 0 : idle_scans_ + 1;
    if (idle_scans_ < kPatience) return false;
    frontiers_.forget_aside();
    const std::vector<Eigen::Vector2d> border_map_m = reachable_border();
    add_frontiers(border_map_m);
    leaves_open_ground_ = std::ranges::any_of(border_map_m, [&](const Eigen::Vector2d& point) {
      return region_.is_open_ground(point) && is_worth_a_way(unknown_area_m2(robot_.grid(), point));
    });
    return frontiers_.frontiers().empty();
  }

  /// The free cells beside unknown ones that can be approached.
  std::vector<Eigen::Vector2d> reachable_border() const;

  DriveRegion region_;
  PlaneRobot& robot_;
  const std::function<void()>& on_scan_;
  DriveCosts costs_;
  FrontierTrees trees_;
  FrontierFilter frontiers_;
  std::optional<Eigen::Vector2d> goal_frontier_map_m_;
  int idle_scans_ = 0;
  bool leaves_open_ground_ = false;
};

std::vector<Eigen::Vector2d> Explorer::reachable_border() const {
  const OccupancyGrid& grid = robot_.grid();
  const auto is_unknown = [&](const Cell& cell) { return grid.state(cell) == CellState::unknown; };
  GridPlanner planner(costs_, robot_.position_map_m(), grid.bounds());
  std::vector<Eigen::Vector2d> border_map_m;
  for (int y = grid.bounds().min().y(); y <= grid.bounds().max().y(); ++y) {
    for (int x = grid.bounds().min().x(); x <= grid.bounds().max().x(); ++x) {
      if (grid.state({x, y}) != CellState::free) continue;
      if (!is_unknown({x + 1, y}) && !is_unknown({x - 1, y}) && !is_unknown({x, y + 1}) &&
          !is_unknown({x, y - 1})) {
        continue;
      }
      const Eigen::Vector2d position_map_m = grid.centre_map_m({x, y});
      const std::optional<Cell> cell = approach_cell(costs_, position_map_m);
      if (cell && planner.cost_m(*cell)) border_map_m.push_back(position_map_m);
    }
  }
  return border_map_m;
}

}  // namespace

std::string to_string(ExplorationStatus status) { return std::string(enum_name(status)); }

ExplorationStatus explore_plane(PlaneRobot& robot, const ExplorationOptions& options,
                                const std::function<void()>& on_scan) {
  return Explorer(robot, options, on_scan).run();
}

Exploration explore(const Scene& scene, const Transform& T_map_base,
                    const ExplorationOptions& options) {
  PlaneRobot robot(scene, T_map_base, options);
  const ExplorationStatus status = explore_plane(robot, options, [] {});
  return {status, robot.trajectory(), robot.grid()};
}

}  // namespace nbvopt
