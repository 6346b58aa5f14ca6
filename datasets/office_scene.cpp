#include "office_scene.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

namespace nbvopt {
namespace {

using SceneBoxes = std::vector<SceneBox>;

/// The walls, floor and ceiling: a solid block, out of which cut_out() is cut.
const SceneBox kBuilding{{-0.1, -0.1, -0.1}, {8.1, 6.1, 2.7}};

SceneBoxes cut_out() {
  return {
      {{0.0, 0.0, 0.0}, {8.0, 1.4, 2.6}},  // corridor
      {{0.0, 1.5, 0.0}, {4.7, 6.0, 2.6}},  // office
      {{4.8, 1.5, 0.0}, {8.0, 6.0, 2.6}},  // meeting room
      {{1.5, 1.4, 0.0}, {2.4, 1.5, 2.1}},  // door to the office
      {{5.6, 1.4, 0.0}, {6.5, 1.5, 2.1}},  // door to the meeting room
      {{1.6, 6.0, 0.9}, {3.4, 6.1, 2.0}},  // window of the office
      {{8.0, 3.0, 0.9}, {8.1, 4.6, 2.0}},  // window of the meeting room
  };
}

/// A plate of 5 cm on four legs.
void add_table(SceneBoxes& boxes, double x, double y, double length, double width, double height) {
  constexpr double kThickness = 0.05;
  boxes.push_back({{x, y, height}, {x + length, y + width, height + kThickness}});
  for (const double leg_x : {x, x + length - kThickness}) {
    for (const double leg_y : {y, y + width - kThickness}) {
      boxes.push_back({{leg_x, leg_y, 0.0}, {leg_x + kThickness, leg_y + kThickness, height}});
    }
  }
}

/// A seat of 0.4 m with a back on its side of greater (+1) or lesser (-1) y.
void add_chair(SceneBoxes& boxes, double x, double y, int back) {
  constexpr double kSize = 0.4;
  add_table(boxes, x, y, kSize, kSize, 0.45);
  const double back_y = back > 0 ? y + kSize - 0.05 : y;
  boxes.push_back({{x, back_y, 0.5}, {x + kSize, back_y + 0.05, 0.9}});
}

/// Boards between two sides, against the wall at lesser x.
void add_shelf(SceneBoxes& boxes, double x, double y, double depth, double width, double height) {
  constexpr double kThickness = 0.05;
  for (const double side_y : {y, y + width - kThickness}) {
    boxes.push_back({{x, side_y, 0.0}, {x + depth, side_y + kThickness, height}});
  }
  constexpr int kBoards = 5;
  for (int i = 0; i < kBoards; ++i) {
    const double z = i * (height - kThickness) / (kBoards - 1);
    boxes.push_back({{x, y, z}, {x + depth, y + width, z + kThickness}});
  }
}

SceneBoxes furniture() {
  SceneBoxes boxes;
  // Office.
  add_table(boxes, 1.7, 5.2, 1.6, 0.8, 0.7);  // desk under the window
  add_chair(boxes, 2.3, 4.6, -1);
  add_table(boxes, 3.9, 2.7, 0.8, 1.6, 0.7);  // desk at the east wall
  add_chair(boxes, 3.4, 3.3, -1);
  add_shelf(boxes, 0.0, 3.0, 0.35, 1.6, 1.8);
  boxes.push_back({{0.0, 1.5, 0.0}, {0.5, 2.1, 1.2}});  // cabinet
  boxes.push_back({{4.3, 5.5, 0.0}, {4.6, 5.8, 0.9}});  // plant
  // Meeting room.
  add_table(boxes, 5.5, 3.2, 1.8, 1.1, 0.7);
  for (const double x : {5.8, 6.6}) {
    add_chair(boxes, x, 2.7, -1);
    add_chair(boxes, x, 4.4, +1);
  }
  boxes.push_back({{4.8, 5.5, 0.0}, {6.4, 6.0, 0.8}});  // sideboard
  // Corridor.
  add_table(boxes, 3.2, 0.0, 1.4, 0.4, 0.4);            // bench
  boxes.push_back({{7.4, 0.7, 0.0}, {8.0, 1.3, 0.6}});  // parcels
  return boxes;
}

/// The coordinates on an axis where something begins or ends.
std::vector<double> cuts(const SceneBoxes& boxes, Eigen::Index axis) {
  std::set<double> cuts{kBuilding.min_m[axis], kBuilding.max_m[axis]};
  for (const SceneBox& box : boxes) cuts.insert({box.min_m[axis], box.max_m[axis]});
  return {cuts.begin(), cuts.end()};
}

/// Adds a box, or lengthens the one before where it goes on along z.
void add_or_lengthen(SceneBoxes& boxes, const SceneBox& box) {
  if (!boxes.empty()) {
    SceneBox& last = boxes.back();
    const bool is_same_column =
        last.min_m.head<2>() == box.min_m.head<2>() && last.max_m.head<2>() == box.max_m.head<2>();
    if (is_same_column && last.max_m.z() == box.min_m.z()) {
      last.max_m.z() = box.max_m.z();
      return;
    }
  }
  boxes.push_back(box);
}

/// What is left of the building: the cuts' planes divide it into blocks, each solid or empty.
SceneBoxes walls() {
  const SceneBoxes empty = cut_out();
  const auto is_solid = [&](const Eigen::Vector3d& p) {
    return std::ranges::none_of(empty, [&](const SceneBox& box) {
      return (p.array() > box.min_m.array()).all() && (p.array() < box.max_m.array()).all();
    });
  };
  const std::vector<double> xs = cuts(empty, 0);
  const std::vector<double> ys = cuts(empty, 1);
  const std::vector<double> zs = cuts(empty, 2);
  SceneBoxes boxes;
  for (std::size_t x = 1; x < xs.size(); ++x) {
    for (std::size_t y = 1; y < ys.size(); ++y) {
      for (std::size_t z = 1; z < zs.size(); ++z) {
        const SceneBox block{{xs[x - 1], ys[y - 1], zs[z - 1]}, {xs[x], ys[y], zs[z]}};
        if (is_solid(0.5 * (block.min_m + block.max_m))) add_or_lengthen(boxes, block);
      }
    }
  }
  return boxes;
}

/// Writes every voxel that shares volume with the box.
void paint(UncertaintyMap& map, const SceneBox& box, const VoxelRecord& record) {
  // Faces lie on voxel faces: without the margin, rounding would decide the neighbour's fate.
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(1e-6);
  const VoxelKey min = map.lattice().key(box.min_m + margin);
  const VoxelKey max = map.lattice().key(box.max_m - margin);
  for (std::uint16_t x = min.x; x <= max.x; ++x) {
    for (std::uint16_t y = min.y; y <= max.y; ++y) {
      for (std::uint16_t z = min.z; z <= max.z; ++z) map.set({x, y, z}, record);
    }
  }
}

}  // namespace

std::vector<SceneBox> office_boxes() {
  SceneBoxes boxes = walls();
  std::ranges::copy(furniture(), std::back_inserter(boxes));
  return boxes;
}

UncertaintyMap make_office(double resolution_m) {
  const VoxelRecord solid{.state = VoxelState::occupied, .log_odds = 3.5F};
  const VoxelRecord air{.state = VoxelState::free, .log_odds = -2.0F};
  UncertaintyMap map(resolution_m);
  paint(map, kBuilding, solid);
  for (const SceneBox& box : cut_out()) paint(map, box, air);
  for (const SceneBox& box : furniture()) paint(map, box, solid);
  map.finish_writing();
  return map;
}

std::vector<Transform> office_stops() {
  constexpr double kNorth = std::numbers::pi / 2.0;
  // Off the lattice's planes, so that no ray grazes a voxel's face over its whole length.
  constexpr double kCorridorY = 0.713;
  constexpr double kDoorX = 1.937;
  std::vector<Transform> stops;
  for (const double x : {0.617, 0.947, 1.277, 1.607}) {
    stops.push_back(base_pose(x, kCorridorY, 0.0, 0.0));
  }
  for (const double yaw : {0.0, 0.25 * kNorth, 0.5 * kNorth, 0.75 * kNorth}) {
    stops.push_back(base_pose(kDoorX, kCorridorY, 0.0, yaw));
  }
  for (const double y : {kCorridorY, 1.093, 1.473, 1.853, 2.233, 2.613}) {
    stops.push_back(base_pose(kDoorX, y, 0.0, kNorth));
  }
  return stops;
}

}  // namespace nbvopt
