#include "bench/chamber.hpp"

#include <array>
#include <cmath>
#include <random>

#include "support/made_map.hpp"

namespace nbvopt::bench {
namespace {

/// Random voxels, in blocks of 4 x 4 x 4: fine ones one by one would take long.
void scatter_blocks(UncertaintyMap& map, const KeyBox& box, double clutter,
                    std::mt19937_64& random) {
  constexpr int kBlock = 4;
  for (int z = box.min.z; z <= box.max.z; z += kBlock) {
    for (int y = box.min.y; y <= box.max.y; y += kBlock) {
      for (int x = box.min.x; x <= box.max.x; x += kBlock) {
        const VoxelRecord voxel = test::random_voxel(random, clutter);
        if (voxel.state == VoxelState::unknown) continue;
        test::set_box(map, test::cube(test::key_at(x, y, z), kBlock), voxel);
      }
    }
  }
}

}  // namespace

UncertaintyMap make_chamber(std::uint64_t number) {
  constexpr std::array kResolutions_m{0.5, 0.2, 0.1, 0.05};
  constexpr double kReach_m = 3.0;
  std::mt19937_64 random(number);
  const auto uniform = [&random](double min, double max) {
    return test::uniform(random, min, max);
  };
  const double resolution_m = kResolutions_m[number % kResolutions_m.size()];
  UncertaintyMap map(resolution_m);
  const Lattice& lattice = map.lattice();
  const double clutter = uniform(0.1, 0.8);
  const auto point = [&](double min_x, double max_x, double min_z, double max_z) {
    const double x = uniform(min_x, max_x);
    const double y = uniform(min_x, max_x);
    return Eigen::Vector3d(x, y, uniform(min_z, max_z));
  };
  const Eigen::Vector3d camera = point(-1.0, 1.0, -0.5, 0.5);
  const Eigen::Vector3d below = point(0.03, 1.2, 0.03, 0.8);
  const Eigen::Vector3d above = point(0.03, 1.2, 0.5, 1.5);
  const Eigen::Vector3d reach_m =
      Eigen::Vector3d::Constant(resolution_m * std::ceil(kReach_m / resolution_m));
  const KeyBox all{lattice.key(camera - reach_m), lattice.key(camera + reach_m)};
  constexpr double kFine_m = 0.1 - 1e-9;
  if (resolution_m > kFine_m) {
    test::scatter(map, all, clutter, random);
  } else {
    scatter_blocks(map, all, clutter, random);
  }
  test::set_box(map, {lattice.key(camera - below), lattice.key(camera + above)}, test::kFree);
  map.finish_writing();
  return map;
}

}  // namespace nbvopt::bench
