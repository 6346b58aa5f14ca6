#include "sim/exploration/frontier_trees.hpp"

#include <cstddef>
#include <nanoflann.hpp>

#include "core/uniform.hpp"
#include "sim/exploration/cell_walk.hpp"

namespace nbvopt {
namespace {

constexpr double kEdge_m = 1.0;
constexpr int kSamples = 50;  ///< for each tree, each time

}  // namespace

/// The points and their index, which asks this for them.
struct RapidTree::Nodes {
  explicit Nodes(const Eigen::Vector2d& root_map_m) : points_map_m{root_map_m}, index(2, *this) {}
  Nodes(const Nodes&) = delete;
  Nodes& operator=(const Nodes&) = delete;

  void add(const Eigen::Vector2d& point_map_m) {
    points_map_m.push_back(point_map_m);
    index.addPoints(points_map_m.size() - 1, points_map_m.size() - 1);
  }

  const Eigen::Vector2d& nearest(const Eigen::Vector2d& position_map_m) const {
    std::size_t nearest = 0;
    double squared_distance = 0.0;
    nanoflann::KNNResultSet<double> result(1);
    result.init(&nearest, &squared_distance);
    index.findNeighbors(result, position_map_m.data(), {});
    return points_map_m[nearest];
  }

  // What nanoflann asks for.
  std::size_t kdtree_get_point_count() const { return points_map_m.size(); }
  double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points_map_m[point][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*unknown*/) const {
    return false;
  }

  std::vector<Eigen::Vector2d> points_map_m;
  // With the dimension as its argument nanoflann 1.4 copies a box that it has not filled.
  static constexpr int kDimensionGivenLater = -1;
  nanoflann::KDTreeSingleIndexDynamicAdaptor<nanoflann::L2_Simple_Adaptor<double, Nodes>, Nodes,
                                             kDimensionGivenLater, std::size_t>
      index;
};

RapidTree::RapidTree(const Eigen::Vector2d& root_map_m)
    : nodes_(std::make_unique<Nodes>(root_map_m)) {}
RapidTree::~RapidTree() = default;
RapidTree::RapidTree(RapidTree&&) noexcept = default;
RapidTree& RapidTree::operator=(RapidTree&&) noexcept = default;

std::optional<Eigen::Vector2d> RapidTree::grow(const OccupancyGrid& grid,
                                               const Eigen::Vector2d& sample_map_m, double edge_m) {
  const Eigen::Vector2d from = nodes_->nearest(sample_map_m);
  const Eigen::Vector2d way = sample_map_m - from;
  const Eigen::Vector2d to =
      way.norm() <= edge_m ? sample_map_m : Eigen::Vector2d(from + edge_m * way.normalized());

  CellState met = CellState::free;
  std::optional<Eigen::Vector2d> last_free;
  walk_cells(from / grid.cell_m(), to / grid.cell_m(), [&](const Cell& cell) {
    met = grid.state(cell);
    if (met == CellState::free) last_free = grid.centre_map_m(cell);
    return met == CellState::free;
  });
  if (met == CellState::free) nodes_->add(to);
  return met == CellState::unknown ? last_free : std::nullopt;
}

FrontierTrees::FrontierTrees(const Eigen::Vector2d& start_map_m, std::uint64_t seed)
    : global_(start_map_m), local_(start_map_m), random_(seed) {}

std::vector<Eigen::Vector2d> FrontierTrees::grow(const OccupancyGrid& grid,
                                                 const Eigen::Vector2d& robot_map_m) {
  std::vector<Eigen::Vector2d> frontiers;
  for (int i = 0; i < kSamples; ++i) {
    if (const auto frontier = global_.grow(grid, sample(grid), kEdge_m)) {
      frontiers.push_back(*frontier);
    }
    if (const auto frontier = local_.grow(grid, sample(grid), kEdge_m)) {
      frontiers.push_back(*frontier);
      local_ = RapidTree(robot_map_m);
    }
  }
  return frontiers;
}

Eigen::Vector2d FrontierTrees::sample(const OccupancyGrid& grid) {
  // An edge beyond what is known, since the unknown starts there.
  const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(kEdge_m);
  const Eigen::Vector2d min_map_m = grid.centre_map_m(grid.bounds().min()) - margin_m;
  const Eigen::Vector2d size_m = grid.centre_map_m(grid.bounds().max()) + margin_m - min_map_m;
  const double x = uniform(random_);
  const double y = uniform(random_);
  return min_map_m + Eigen::Vector2d(x * size_m.x(), y * size_m.y());
}

}  // namespace nbvopt
