#include "nbvopt/map/voxel_grid.hpp"

#include "map/brick_table.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

using detail::BrickTable;

VoxelGrid::VoxelGrid(const Lattice& lattice, std::unique_ptr<BrickTable> table,
                     std::uint64_t version, bool carries_uncertainty)
    : lattice_(lattice),
      table_(std::move(table)),
      version_(version),
      carries_uncertainty_(carries_uncertainty) {}

VoxelGrid::~VoxelGrid() = default;

std::shared_ptr<const VoxelGrid> VoxelGrid::lazy(const UncertaintyMap& map) {
  return std::shared_ptr<const VoxelGrid>(new VoxelGrid(
      map.lattice(), std::make_unique<BrickTable>(map.tree()), 1, map.carries_uncertainty()));
}

std::shared_ptr<const VoxelGrid> VoxelGrid::whole(const UncertaintyMap& map) {
  auto table = std::make_unique<BrickTable>(map.tree());
  table->read_all();
  return std::shared_ptr<const VoxelGrid>(
      new VoxelGrid(map.lattice(), std::move(table), 1, map.carries_uncertainty()));
}

std::shared_ptr<const VoxelGrid> VoxelGrid::updated(std::span<const VoxelChange> changes) const {
  if (!table_->is_whole()) {
    throw UsageError("only a whole voxel grid can follow a growing map: make it by whole()");
  }
  bool carries_uncertainty = carries_uncertainty_;
  for (const VoxelChange& c : changes) carries_uncertainty |= c.uncertainty != kUnknownUncertainty;
  return std::shared_ptr<const VoxelGrid>(new VoxelGrid(
      lattice_, std::make_unique<BrickTable>(*table_, changes), version_ + 1, carries_uncertainty));
}

void VoxelGrid::make_ready(const KeyBox& box) const { table_->make_ready(detail::bricks_of(box)); }

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

std::size_t VoxelGrid::memory_bytes() const { return table_->memory_bytes(); }

}  // namespace nbvopt
