#include "map/segment_walk.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

namespace nbvopt {
namespace {

using Cell = std::array<int, 3>;

/// A coordinate's part of a number that holds all three.
struct Part {
  int shift;
  std::uint64_t operator[](int coordinate) const {
    return static_cast<std::uint64_t>(coordinate) << shift;
  }
};

std::set<Cell> walked_cells(const SegmentWalk& walk) {
  std::set<Cell> cells;
  walk.for_each_cell(std::array{Part{0}, Part{20}, Part{40}}, [&](std::uint64_t number) {
    const auto coordinate = [&](int shift) { return static_cast<int>(number >> shift & 0xFFFFF); };
    cells.insert({coordinate(0), coordinate(20), coordinate(40)});
  });
  return cells;
}

/// How much of the segment, as a part of its length, lies in the cell; negative when it misses it.
double part_inside(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Cell& cell) {
  double enter = 0.0;
  double leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = to[axis] - from[axis];
    const double at_least = (cell[axis] - from[axis]) / extent;
    const double at_most = (cell[axis] + 1 - from[axis]) / extent;
    enter = std::max(enter, std::min(at_least, at_most));
    leave = std::min(leave, std::max(at_least, at_most));
  }
  return leave - enter;
}

/// Every cell that the segment passes through, found without walking.
void expect_pierced_cells(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                          const Eigen::Vector3d& least, const Eigen::Vector3d& most,
                          const std::set<Cell>& cells) {
  constexpr double kGrazing = 1e-9;
  const Eigen::Vector3i first = from.cwiseMin(to).cwiseMax(least).cast<int>();
  const Eigen::Vector3i last = from.cwiseMax(to).cwiseMin(most).cast<int>();
  for (int x = first.x(); x <= last.x(); ++x) {
    for (int y = first.y(); y <= last.y(); ++y) {
      for (int z = first.z(); z <= last.z(); ++z) {
        const bool is_in_box =
            x < most.x() && y < most.y() && z < most.z();  // least and most are whole
        if (is_in_box && part_inside(from, to, {x, y, z}) > kGrazing) {
          EXPECT_TRUE(cells.contains({x, y, z})) << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
  for (const Cell& cell : cells) EXPECT_GT(part_inside(from, to, cell), -kGrazing);
}

class RandomPoints {
 public:
  Eigen::Vector3d next(double least, double most) {
    std::uniform_real_distribution<double> coordinate(least, most);
    return {coordinate(random_), coordinate(random_), coordinate(random_)};
  }

 private:
  std::mt19937 random_{7};
};

TEST(SegmentWalk, VisitsEveryPiercedCellAndNoOther) {
  RandomPoints points;
  const Eigen::Vector3d least = Eigen::Vector3d::Zero();
  const Eigen::Vector3d most = Eigen::Vector3d::Constant(65536.0);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d from = points.next(32760.0, 32776.0);
    const Eigen::Vector3d to = points.next(32756.0, 32780.0);
    expect_pierced_cells(from, to, least, most, walked_cells(SegmentWalk(from, to)));
  }
}

TEST(SegmentWalk, HasNoDirection) {
  RandomPoints points;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d from = points.next(0.0, 40.0);
    const Eigen::Vector3d to = points.next(0.0, 40.0);
    EXPECT_EQ(walked_cells(SegmentWalk(from, to)), walked_cells(SegmentWalk(to, from)));
  }
}

TEST(SegmentWalk, StaysInOneRowAlongAnAxis) {
  const auto cells = walked_cells(SegmentWalk({5.5, 2.5, 3.5}, {1.25, 2.5, 3.5}));
  EXPECT_EQ(cells, (std::set<Cell>{{1, 2, 3}, {2, 2, 3}, {3, 2, 3}, {4, 2, 3}, {5, 2, 3}}));
}

TEST(SegmentWalk, OfNoLengthIsItsCell) {
  EXPECT_EQ(walked_cells(SegmentWalk({5.5, 2.0, 3.9}, {5.5, 2.0, 3.9})),
            (std::set<Cell>{{5, 2, 3}}));
}

TEST(SegmentWalk, HoldsTheCellsOfBothEnds) {
  RandomPoints points;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d from = points.next(0.0, 40.0);
    const Eigen::Vector3d to = points.next(0.0, 40.0).array().floor();  // on faces and corners
    const auto cells = walked_cells(SegmentWalk(from, to));
    for (const Eigen::Vector3d& p : {from, to}) {
      EXPECT_TRUE(cells.contains({int(p.x()), int(p.y()), int(p.z())})) << p.transpose();
    }
  }
}

TEST(SegmentWalk, ClippedToABoxVisitsTheBoxesCells) {
  RandomPoints points;
  const Eigen::Vector3d least(8.0, 16.0, 8.0);
  const Eigen::Vector3d most(24.0, 24.0, 32.0);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d from = points.next(0.0, 40.0);
    const Eigen::Vector3d to = points.next(0.0, 40.0);
    SegmentWalk walk(from, to);
    const bool is_inside = walk.clip(least, most);
    expect_pierced_cells(from, to, least, most, is_inside ? walked_cells(walk) : std::set<Cell>{});
    hits += is_inside;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 400);
}

}  // namespace
}  // namespace nbvopt
