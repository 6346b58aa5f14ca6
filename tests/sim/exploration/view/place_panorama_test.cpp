// What looking around promises, on maps where the answer can be counted.
#include "sim/exploration/view/place_panorama.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "nbvopt/sensor/uncertainty_model.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// Sees two metres far.
Robot short_sighted(GainKind gain) {
  Robot robot;
  robot.sensor.gain = gain;
  robot.sensor.range_max_m = 2.0;
  return robot;
}

/// A board of 1 x 0.8 m a metre ahead of the origin, of voxels with that u, in free space that
/// reaches beyond the camera's range.
class Board {
 public:
  explicit Board(float uncertainty) {
    const Lattice& lattice = map_.lattice();
    set_box(map_, keys_between(lattice, {-2.2, -2.2, -2.0}, {2.2, 2.2, 2.8}), kFree);
    board_ = keys_between(lattice, {1.0, -0.5, 0.0}, {1.1, 0.5, 0.8});
    set_box(map_, board_, occupied(uncertainty));
  }

  PlaceGain look_around(GainKind gain) const {
    return PlacePanorama(short_sighted(gain), map_.resolution_m())
        .look_around(*VoxelGrid::whole(map_), HazardTable(), Eigen::Vector3d::Zero());
  }

  /// Eq. 12 of every voxel of the board, seen from half way up the mast at a quarter of the angle
  /// uncertainty that there is.
  double expected(double u_old) const {
    const UncertaintyModel model{short_sighted(GainKind::positive).sensor};
    double information = 0.0;
    for_each_key(board_, [&](VoxelKey key) {
      const Eigen::Vector3d seen_m =
          map_.lattice().centre_m(key) - Eigen::Vector3d(0.05, 0.0, 0.405);
      const double u_new = 0.5 * model.distance_uncertainty(seen_m.norm()) + 0.5 * 0.25;
      information += std::max(0.0, u_old - u_new);
    });
    return information;
  }

 private:
  UncertaintyMap map_{0.1};
  KeyBox board_;
};

double total(const PlaceGain& gain) {
  double information = 0.0;
  for (const CubeGain& part : gain) information += part.information;
  return information;
}

TEST(PlacePanorama, CountsTheVoxelsThatCouldBeSeenBetter) {
  const Board board(0.9F);
  for (const GainKind gain : {GainKind::positive, GainKind::expected}) {
    EXPECT_NEAR(total(board.look_around(gain)), board.expected(0.9), 0.1 * board.expected(0.9));
  }
}

TEST(PlacePanorama, PromisesNothingWhereAllIsKnownWell) {
  EXPECT_TRUE(Board(0.1F).look_around(GainKind::expected).empty());
}

TEST(PlacePanorama, TellsCubesApart) {
  const PlaceGain gain = Board(0.9F).look_around(GainKind::positive);
  EXPECT_EQ(gain.size(), 4U) << "half a metre each: two beside each other, two above";
  EXPECT_TRUE(std::ranges::is_sorted(gain, std::ranges::less_equal{}, &CubeGain::cube));
}

TEST(PlacePanorama, LooksAtTheUnknownInItsWay) {
  const UncertaintyMap nothing(0.1);
  const PlacePanorama positive(short_sighted(GainKind::positive), 0.1);
  const PlacePanorama expected(short_sighted(GainKind::expected), 0.1);
  const auto grid = VoxelGrid::whole(nothing);
  // All rays end where they begin, half a metre away, or go on to where a surface may be.
  EXPECT_GT(total(positive.look_around(*grid, HazardTable(), Eigen::Vector3d::Zero())), 0.0);
  const double of_few =
      total(expected.look_around(*grid, HazardTable::uniform(0.1), Eigen::Vector3d::Zero()));
  const double of_many =
      total(expected.look_around(*grid, HazardTable::uniform(0.5), Eigen::Vector3d::Zero()));
  EXPECT_GT(of_few, 0.0);
  EXPECT_GT(of_many, 2.0 * of_few) << "the likelier surfaces are, the more is to be had";
}

TEST(PlacePanorama, KnowsHowManyImagesGoAround) {
  SensorOptions sensor;
  EXPECT_EQ(views_around(sensor), 7) << "of 59 degrees";
  sensor.half_fov_horizontal_rad = 0.8;
  EXPECT_EQ(views_around(sensor), 4);
}

}  // namespace
}  // namespace nbvopt::test
