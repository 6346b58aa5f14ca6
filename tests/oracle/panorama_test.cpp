// The panorama against the exact gain, on maps with known answers: many places, many views of each.
#include "nbvopt/gain/panorama.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <string>
#include <tuple>
#include <vector>

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/made_map.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"
#include "support/sanitizers.hpp"

namespace nbvopt {
namespace {

using test::uniform;

constexpr int kPlaces = test::kAddressSanitizer ? 5 : 50;
constexpr int kViews = 40;

/// What is asked of the panorama, and how well it must answer.
struct Agreement {
  std::string name;
  bool at_layers = false;  ///< views from the heights of layers only
  Counting counting = Counting::per_ray;
  Eigen::Vector3d sensor_offset_m = Eigen::Vector3d::Zero();
  BaseTwist base_twist;
  double pooled_correlation = 0.0;  ///< at least
  double worst_correlation = 0.0;   ///< of a place, at least
  double bias = 1.0;                ///< at most
};

void PrintTo(const Agreement& agreement, std::ostream* out) { *out << agreement.name; }

std::vector<Agreement> agreements() {
  std::vector<Agreement> all(5);
  all[0].name = "at_layers";
  all[0].at_layers = true;
  all[0].pooled_correlation = 0.9995;
  all[0].worst_correlation = 0.98;
  all[0].bias = 0.01;

  all[1].name = "anywhere";
  all[1].pooled_correlation = 0.999;
  all[1].worst_correlation = 0.98;
  all[1].bias = 0.01;

  all[2].name = "lever_arm";
  all[2].sensor_offset_m = {0.06, 0.0, 0.0};
  all[2].pooled_correlation = 0.99;
  all[2].bias = 0.03;

  all[3].name = "per_voxel";
  all[3].counting = Counting::per_voxel;
  all[3].pooled_correlation = 0.998;

  all[4].name = "moving_base";
  all[4].base_twist = {.vx_m_s = 0.3, .vy_m_s = 0.0, .wz_rad_s = 0.3};
  all[4].pooled_correlation = 0.99;
  return all;
}

double correlation(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
  const Eigen::ArrayXd da = a - a.mean();
  const Eigen::ArrayXd db = b - b.mean();
  return (da * db).sum() / std::sqrt(da.square().sum() * db.square().sum());
}

/// A place whose mast and some room around it is free, the base on the floor.
Transform free_place(const UncertaintyMap& map, std::mt19937_64& random) {
  constexpr double kRoom_m = 0.15;
  const KeyBox known = *map.known_box();
  const Eigen::Vector3d min_m = map.lattice().centre_m(known.min);
  const Eigen::Vector3d max_m = map.lattice().centre_m(known.max);
  for (;;) {
    const double x_m = uniform(random, min_m.x(), max_m.x());
    const double y_m = uniform(random, min_m.y(), max_m.y());
    const double yaw_rad = uniform(random, -3.0, 3.0);
    const KeyBox room{map.lattice().key({x_m - kRoom_m, y_m - kRoom_m, 0.1}),
                      map.lattice().key({x_m + kRoom_m, y_m + kRoom_m, 0.7})};
    bool is_free = true;
    test::for_each_key(
        room, [&](VoxelKey key) { is_free = is_free && map.at(key).state == VoxelState::free; });
    if (is_free) return base_pose(x_m, y_m, 0.0, yaw_rad);
  }
}

/// Gains of the same views.
struct Gains {
  Eigen::ArrayXd surrogate = Eigen::ArrayXd(kViews);
  Eigen::ArrayXd exact = Eigen::ArrayXd(kViews);
};

Gains gains_at(const Transform& T_map_base, const Agreement& agreement,
               const std::shared_ptr<const VoxelGrid>& grid, std::mt19937_64& random) {
  SensorOptions sensor;
  sensor.counting = agreement.counting;
  MastOptions options;
  options.sensor_offset_m = agreement.sensor_offset_m;
  const Mast mast(options);
  const JointPosition joints{uniform(random, -3.0, 3.0), uniform(random, -0.4, 0.4),
                             uniform(random, 0.25, 0.55)};
  const MovingMast moving(mast, T_map_base, agreement.base_twist, joints);
  const JointBox box = mast.reachable_box(joints, 1.0);
  const Panorama panorama(grid, sensor, moving, box);
  const auto exact = make_exact_evaluator(grid, DepthCamera(sensor));
  Gains gains;
  for (Eigen::Index view = 0; view < kViews; ++view) {
    JointPosition q{uniform(random, box.min[0], box.max[0]),
                    uniform(random, box.min[1], box.max[1]),
                    uniform(random, box.min[2], box.max[2])};
    if (agreement.at_layers) q.height_m = view % 2 ? box.max[2] : box.min[2];
    gains.surrogate[view] = panorama.gain(q);
    gains.exact[view] = exact->evaluate(moving.T_map_sensor(q)).gain;
  }
  return gains;
}

class PanoramaOracle : public ::testing::TestWithParam<std::tuple<const char*, Agreement>> {};

TEST_P(PanoramaOracle, AgreesWithTheExactGain) {
  const auto& [file, agreement] = GetParam();
  const std::filesystem::path path = test::known_map_file(file);
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << file << " of ../shared is not here, so this was not tested";
  }
  const UncertaintyMap map = read_map(path);
  const auto grid = VoxelGrid::whole(map);

  std::mt19937_64 random(2024);
  Eigen::ArrayXd surrogate(kPlaces * kViews);
  Eigen::ArrayXd exact(kPlaces * kViews);
  std::vector<double> of_places;
  for (Eigen::Index place = 0; place < kPlaces; ++place) {
    const Gains gains = gains_at(free_place(map, random), agreement, grid, random);
    surrogate.segment(place * kViews, kViews) = gains.surrogate;
    exact.segment(place * kViews, kViews) = gains.exact;
    of_places.push_back(correlation(gains.surrogate, gains.exact));
  }
  std::sort(of_places.begin(), of_places.end());
  const double pooled = correlation(surrogate, exact);
  const double bias = surrogate.sum() / exact.sum() - 1.0;
  std::cout << std::fixed << std::setprecision(5) << std::left << std::setw(21) << file
            << std::setw(12) << agreement.name << std::right << " pooled " << pooled
            << ", median place " << of_places[of_places.size() / 2] << ", worst "
            << of_places.front() << ", bias " << std::showpos << bias << std::noshowpos << '\n';

  EXPECT_GE(pooled, agreement.pooled_correlation);
  EXPECT_GE(of_places.front(), agreement.worst_correlation);
  EXPECT_LE(std::abs(bias), agreement.bias);
}

INSTANTIATE_TEST_SUITE_P(
    Maps, PanoramaOracle,
    ::testing::Combine(::testing::Values("ASLAM_lab.bt", "apartment_partial.ot",
                                         "warehouse_partial.ot", "office_partial.ot"),
                       ::testing::ValuesIn(agreements())),
    [](const auto& variant) {
      const std::string file = std::get<0>(variant.param);
      return file.substr(0, file.find('.')) + "_" + std::get<1>(variant.param).name;
    });

}  // namespace
}  // namespace nbvopt
