#include "nbvopt/map/voxel_grid.hpp"

#include <algorithm>
#include <vector>

#include "map/brick_table.hpp"
#include "map/map_access.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// The bricks that touch the surroundings.
std::vector<detail::BrickKey> bricks_of(const Lattice& lattice, const Surroundings& near) {
  const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(near.radius_m);
  const detail::BrickBox box = detail::bricks_of(
      {lattice.key(near.box_map_m.min() - reach_m), lattice.key(near.box_map_m.max() + reach_m)});
  detail::check_size(box);
  const Eigen::AlignedBox3d box_lattice(lattice.to_lattice(near.box_map_m.min()),
                                        lattice.to_lattice(near.box_map_m.max()));
  std::vector<detail::BrickKey> bricks;
  box.for_each([&](detail::BrickKey key) {
    if (box_lattice.exteriorDistance(detail::lattice_box(key)) * lattice.resolution_m() <=
        near.radius_m) {
      bricks.push_back(key);
    }
  });
  return bricks;
}

}  // namespace

using detail::BrickTable;

VoxelGrid::VoxelGrid(const Lattice& lattice, std::unique_ptr<BrickTable> table,
                     std::uint64_t version)
    : lattice_(lattice), table_(std::move(table)), version_(version) {}

VoxelGrid::~VoxelGrid() = default;

std::shared_ptr<VoxelGrid> VoxelGrid::of(const UncertaintyMap& map, std::uint64_t version) {
  std::shared_ptr<VoxelGrid> grid(new VoxelGrid(
      map.lattice(), std::make_unique<BrickTable>(detail::MapAccess::tree(map)), version));
  grid->carries_uncertainty_ = map.carries_uncertainty();
  grid->has_occupied_ = map.has_occupied();
  return grid;
}

std::shared_ptr<const VoxelGrid> VoxelGrid::lazy(const UncertaintyMap& map) { return of(map, 1); }

std::shared_ptr<const VoxelGrid> VoxelGrid::whole(const UncertaintyMap& map,
                                                  std::uint64_t version) {
  const std::shared_ptr<VoxelGrid> grid = of(map, version);
  grid->table_->read_all();
  return grid;
}

std::shared_ptr<const VoxelGrid> VoxelGrid::updated(std::span<const VoxelChange> changes) const {
  if (!table_->is_whole()) {
    throw UsageError("only a whole voxel grid can follow a growing map: make it by whole()");
  }
  std::shared_ptr<VoxelGrid> grid(
      new VoxelGrid(lattice_, std::make_unique<BrickTable>(*table_, changes), version_ + 1));
  grid->carries_uncertainty_ = carries_uncertainty_;
  grid->has_occupied_ = has_occupied_;
  for (const VoxelChange& change : changes) {
    grid->carries_uncertainty_ |= change.uncertainty != kUnknownUncertainty;
    grid->has_occupied_ |= change.state == VoxelState::occupied;
  }
  return grid;
}

void VoxelGrid::make_ready(const KeyBox& box) const {
  table_->make_ready(detail::brick_keys_of(detail::bricks_of(box)));
}

void VoxelGrid::make_ready(const Surroundings& near) const {
  table_->make_ready(bricks_of(lattice_, near));
}

void VoxelGrid::read_all() const { table_->read_all(); }

VoxelState VoxelGrid::state(VoxelKey key) const {
  return table_->ready_brick(detail::brick_of(key))->states->state(key);
}

float VoxelGrid::uncertainty(VoxelKey key) const {
  const detail::BrickStates& states = *table_->ready_brick(detail::brick_of(key))->states;
  return states.state(key) == VoxelState::occupied
             ? states.uncertainty_of_occupied(key, kUnknownUncertainty)
             : kUnknownUncertainty;
}

bool VoxelGrid::any_occupied(const KeyBox& box) const {
  bool found = false;
  const auto first = [](int brick, int key) {
    return std::max(key - brick * detail::kBrickSize, 0);
  };
  const auto last = [](int brick, int key) {
    return std::min(key - brick * detail::kBrickSize, detail::kBrickSize - 1);
  };
  detail::bricks_of(box).for_each([&](detail::BrickKey brick) {
    const detail::BrickStates& states = *table_->ready_brick(brick)->states;
    if (found || !states.has_occupied) return;
    const auto bits = static_cast<std::uint32_t>((std::uint64_t{2} << last(brick.x, box.max.x)) -
                                                 (std::uint64_t{1} << first(brick.x, box.min.x)));
    for (int z = first(brick.z, box.min.z); z <= last(brick.z, box.max.z); ++z) {
      for (int y = first(brick.y, box.min.y); y <= last(brick.y, box.max.y); ++y) {
        found |= (states.occupied[y | z << detail::kBrickBits] & bits) != 0;
      }
    }
  });
  return found;
}

bool VoxelGrid::any_known(const Surroundings& near) const {
  return std::ranges::any_of(bricks_of(lattice_, near), [this](detail::BrickKey brick) {
    return !table_->ready_brick(brick)->states->is_all_unknown();
  });
}

std::size_t VoxelGrid::memory_bytes() const { return table_->memory_bytes(); }

}  // namespace nbvopt
