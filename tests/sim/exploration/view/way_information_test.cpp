// What ways are worth, on cases that are counted by hand.
#include "sim/exploration/view/way_information.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "sim/exploration/marked_grid.hpp"
#include "sim/exploration/view/places.hpp"
#include "sim/exploration/view/promises.hpp"
#include "sim/exploration/view/travel_time.hpp"

namespace nbvopt::test {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(TravelTime, CountsTheWayAndSharpTurns) {
  const BaseOptions base{.speed_max_m_s = 0.5, .turn_rate_max_rad_s = 0.4};
  const Path straight({{0.0, 0.0}, {2.0, 0.0}});
  EXPECT_DOUBLE_EQ(travel_time_s(base, 0.0, straight), 4.0);
  EXPECT_DOUBLE_EQ(travel_time_s(base, kPi / 4.0, straight), 4.0) << "it turns while it drives";
  EXPECT_NEAR(travel_time_s(base, kPi, straight), 4.0 + (kPi - kPi / 3.0) / 0.4, 1e-12);
  EXPECT_NEAR(travel_time_s(base, 5.0 * kPi, straight), 4.0 + (kPi - kPi / 3.0) / 0.4, 1e-12)
      << "yaw runs on over full turns";
  const Path corner({{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}});
  EXPECT_NEAR(travel_time_s(base, 0.0, corner), 6.0 + (kPi / 2.0 - kPi / 3.0) / 0.4, 1e-12);
  EXPECT_EQ(travel_time_s(base, 0.0, Path({{1.0, 1.0}, {1.0, 1.0}})), 0.0);
}

/// Three places in a row, half a metre apart, and one beside the last.
class WayInformationTest : public testing::Test {
 protected:
  WayInformationTest() {
    places_.reserve({Cell(0, 0), Cell(2, 1)});
    places_[{0, 0}] = &first_;
    places_[{1, 0}] = &second_;
    places_[{2, 0}] = &third_;
    places_[{2, 1}] = &beside_;
  }

  double along(const Path& way) const {
    return information_along({&way, 1}, places_, promises_).front();
  }

  const PlaceGain first_{{1, 10.0}, {2, 5.0}};
  const PlaceGain second_{{2, 8.0}, {3, 4.0}};
  const PlaceGain third_{{3, 5.0}, {1, 2.0}};
  const PlaceGain beside_{{2, 9.0}};
  CellArray<const PlaceGain*> places_{nullptr};
  Promises promises_{4.0};
};

TEST_F(WayInformationTest, CountsWhatSeveralPlacesSeeOnce) {
  EXPECT_DOUBLE_EQ(along(Path({{0.1, 0.2}})), 15.0);
  EXPECT_DOUBLE_EQ(along(Path({{0.1, 0.2}, {0.9, 0.2}})), 10.0 + 8.0 + 4.0);
  EXPECT_DOUBLE_EQ(along(Path({{0.9, 0.2}, {0.1, 0.2}, {0.9, 0.2}})), 22.0);
  EXPECT_EQ(along(Path({{7.0, 7.0}, {8.0, 7.0}})), 0.0) << "no place is there";
}

TEST_F(WayInformationTest, DoesNotDependOnTheOtherWays) {
  const std::vector<Path> ways{
      Path({{0.1, 0.2}, {0.9, 0.2}}),
      Path({{0.1, 0.2}, {0.9, 0.2}, {1.2, 0.2}}),
      Path({{0.6, 0.2}, {1.2, 0.2}}),
      Path({{0.1, 0.2}, {0.9, 0.2}, {1.2, 0.4}}),
      Path({{0.1, 0.2}, {1.2, 0.2}, {1.2, 0.9}}),
      Path({{0.1, 0.2}, {0.9, 0.2}}),
      Path({{0.1, 0.2}}),
  };
  EXPECT_EQ(information_along(ways, places_, promises_),
            (std::vector{22.0, 23.0, 15.0, 23.0, 24.0, 22.0, 15.0}));
}

TEST_F(WayInformationTest, LeavesOutWhatIsDoubted) {
  promises_.doubt(PlaceGain{{1, 4.0}, {2, 7.0}});
  EXPECT_DOUBLE_EQ(along(Path({{0.1, 0.2}, {0.9, 0.2}})), 6.0 + 1.0 + 4.0);
}

TEST(Promises, AreJudgedAfterTheirPeriod) {
  Promises promises(4.0);
  promises.promise(100.0);
  EXPECT_FALSE(promises.is_broken(3.0, 0.0)) << "the period is not over";
  EXPECT_TRUE(promises.is_broken(4.0, 99.0)) << "less than a quarter of 400";
  EXPECT_FALSE(promises.is_broken(8.0, 200.0)) << "101 of 400 since";
  promises.promise(10.0);
  EXPECT_FALSE(promises.is_broken(12.0, 211.0)) << "each second counts with its own promise";
}

TEST(Promises, BelieveNoMoreThanWhatIsBeyondDoubt) {
  Promises promises(4.0);
  const PlaceGain gain{{1, 10.0}, {2, 5.0}};
  EXPECT_DOUBLE_EQ(promises.believed(gain), 15.0);
  promises.doubt(PlaceGain{{1, 4.0}, {2, 7.0}});
  promises.doubt(PlaceGain{{1, 3.0}});
  EXPECT_DOUBLE_EQ(promises.believed(gain), 6.0);
  EXPECT_DOUBLE_EQ(promises.believed(gain[1]), 0.0);
}

/// A room of 3 x 2 m, half of it shut off by a wall; the rest of the plane is unknown.
class Places : public testing::Test {
 protected:
  Places() {
    mark(grid_, {0.0, 0.0}, {2.99, 1.99}, CellState::free);
    clearance_.add_occupied(mark(grid_, {1.5, 0.0}, {1.5, 1.99}, CellState::occupied));
  }

  std::vector<Place> places(const ExplorationOptions& options) {
    GridPlanner planner(costs_, {0.5, 1.0}, grid_.bounds());
    return reachable_places(costs_, planner, DriveRegion(options));
  }

  OccupancyGrid grid_{0.05};
  ClearanceField clearance_{0.05, 0.7};
  DriveCosts costs_{grid_, clearance_, {0.27, 0.67, false}};
};

TEST_F(Places, AreWhereTheBaseCanDrive) {
  const std::vector<Place> found = places({});
  ASSERT_EQ(found.size(), 3U * 4U) << "squares of half a metre, those beside the wall included";
  const Place* previous = nullptr;
  for (const Place& place : found) {
    EXPECT_EQ(square_at(place.position_map_m), place.square);
    EXPECT_TRUE(costs_.is_passable(grid_.cell_at(place.position_map_m)));
    EXPECT_LT(place.position_map_m.x(), 1.5 - 0.25);
    if (previous) {
      EXPECT_TRUE(SquareOrder()(previous->square, place.square));
    }
    previous = &place;
  }
  EXPECT_LT((found[0].position_map_m - Eigen::Vector2d(0.25, 0.25)).norm(), 0.05);
}

TEST_F(Places, LieInTheRegion) {
  ExplorationOptions options;
  options.region_map_m = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 2.0}, {0.0, 2.0}};
  EXPECT_EQ(places(options).size(), 4U);
}

}  // namespace
}  // namespace nbvopt::test
