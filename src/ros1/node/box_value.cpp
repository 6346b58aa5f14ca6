#include "ros1/node/box_value.hpp"

#include <algorithm>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr int kBlock = 32;  // voxels along an edge, as bricks have

/// Calls visit(box of keys) for the blocks of the lattice, cut to the box.
template <class Visit>
void for_each_block(const KeyBox& box, const Visit& visit) {
  const auto end_of = [](int key, int max) {
    return std::min(key - key % kBlock + kBlock - 1, max);
  };
  const auto narrow = [](int key) { return static_cast<std::uint16_t>(key); };
  for (int z = box.min.z; z <= box.max.z; z = end_of(z, box.max.z) + 1) {
    for (int y = box.min.y; y <= box.max.y; y = end_of(y, box.max.y) + 1) {
      for (int x = box.min.x; x <= box.max.x; x = end_of(x, box.max.x) + 1) {
        visit(KeyBox{{narrow(x), narrow(y), narrow(z)},
                     {narrow(end_of(x, box.max.x)), narrow(end_of(y, box.max.y)),
                      narrow(end_of(z, box.max.z))}});
      }
    }
  }
}

std::uint64_t voxels_in(const KeyBox& box) {
  const auto edge = [](std::uint16_t min, std::uint16_t max) {
    return std::uint64_t{max} - min + 1;
  };
  return edge(box.min.x, box.max.x) * edge(box.min.y, box.max.y) * edge(box.min.z, box.max.z);
}

void add_voxels(const VoxelGrid& grid, const KeyBox& block, double occupied_uncertainty,
                BoxValue& value) {
  for (int z = block.min.z; z <= block.max.z; ++z) {
    for (int y = block.min.y; y <= block.max.y; ++y) {
      for (int x = block.min.x; x <= block.max.x; ++x) {
        const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                           static_cast<std::uint16_t>(z)};
        const VoxelState state = grid.state(key);
        if (state == VoxelState::unknown) ++value.unknown;
        if (state != VoxelState::occupied) continue;
        const double u =
            grid.carries_uncertainty() ? double{grid.uncertainty(key)} : occupied_uncertainty;
        value.information += 1.0 - u;
        value.uncertainty += u;
      }
    }
  }
}

}  // namespace

KeyBox key_box(const Lattice& lattice, const Eigen::Vector3d& min_m, const Eigen::Vector3d& max_m) {
  if (!min_m.allFinite() || !max_m.allFinite() || (min_m.array() > max_m.array()).any()) {
    throw InputError("the box must be finite, its min nowhere above its max");
  }
  if (!lattice.contains(min_m) || !lattice.contains(max_m)) {
    throw InputError("the box reaches beyond the map's lattice");
  }
  if (((max_m - min_m) / lattice.resolution_m()).array().max(1.0).prod() > kMostBoxVoxels) {
    throw InputError("the box holds more than a thousand million voxels: ask for a smaller one");
  }
  return {lattice.key(min_m), lattice.key(max_m)};
}

BoxValue box_value(const VoxelGrid& grid, const KeyBox& box, double occupied_uncertainty) {
  BoxValue value;
  for_each_block(box, [&](const KeyBox& block) {
    Eigen::AlignedBox3d box_m;
    box_m.extend(grid.lattice().centre_m(block.min));
    box_m.extend(grid.lattice().centre_m(block.max));
    if (grid.any_known({.box_map_m = box_m})) {
      add_voxels(grid, block, occupied_uncertainty, value);
    } else {
      value.unknown += voxels_in(block);
    }
  });
  return value;
}

}  // namespace nbvopt
