#include "web/growing_surface.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <utility>

#include "map/brick_table.hpp"
#include "map/map_access.hpp"
#include "nbvopt/core/error.hpp"
#include "web/packed.hpp"
#include "web/surface_mesh.hpp"

namespace nbvopt {
namespace {

using detail::BrickKey;
using detail::BrickStates;
using detail::BrickTable;
using Place = std::array<int, 3>;

BrickKey key_of(const Place& place) { return {place[0], place[1], place[2]}; }

const BrickStates& states_at(const BrickTable& table, const Place& place) {
  return *table.ready_brick(key_of(place))->states;
}

MapCounts counted(const BrickStates& states) {
  MapCounts counts;
  for (int row = 0; row < detail::kBrickRows; ++row) {
    counts.occupied_voxels += static_cast<std::uint64_t>(std::popcount(states.occupied[row]));
    counts.free_voxels += static_cast<std::uint64_t>(std::popcount(states.free[row]));
  }
  for (const float uncertainty : states.uncertainty) {
    if (!(uncertainty < kUnknownUncertainty)) continue;
    ++counts.certain_voxels;
    counts.information += 1.0 - static_cast<double>(uncertainty);
  }
  return counts;
}

std::string member_of(const Place& place, const SurfaceMesh& mesh) {
  std::string name;
  for (const int bricks : place) {
    name += (name.empty() ? "" : ",") + std::to_string(bricks * detail::kBrickSize);
  }
  return '"' + name + "\":\"" + packed_surface(mesh) + '"';
}

/// Calls visit(place) for each brick of the blocks of some bricks.
template <typename Visit>
void for_each_in_blocks(const std::set<Place>& blocks, const Visit& visit) {
  constexpr int kSize = 1 << detail::kBlockBits;
  for (const Place& block : blocks) {
    const BrickKey first{block[0] * kSize, block[1] * kSize, block[2] * kSize};
    const detail::BrickBox bricks{first,
                                  {first.x + kSize - 1, first.y + kSize - 1, first.z + kSize - 1}};
    bricks.for_each([&](BrickKey key) { visit(Place{key.x, key.y, key.z}); });
  }
}

}  // namespace

void GrowingSurface::show(std::shared_ptr<const VoxelGrid> grid) {
  if (grid->lattice().resolution_m() != resolution_m_) {
    resolution_m_ = grid->lattice().resolution_m();
    grid_ = nullptr;
    bricks_.clear();
    first_ = grid->version();
  }
  const BrickTable& table = detail::MapAccess::table(*grid);
  std::set<Place> blocks;
  for (const BrickKey& block : table.read_blocks()) blocks.insert({block.x, block.y, block.z});
  for (const auto& [place, unused] : bricks_) {
    const auto block = [](int bricks) { return bricks >> detail::kBlockBits; };
    blocks.insert({block(place[0]), block(place[1]), block(place[2])});
  }
  std::set<Place> to_make;
  for_each_in_blocks(blocks, [&](const Place& place) {
    const BrickStates& now = states_at(table, place);
    const bool is_as_before = grid_ != nullptr
                                  ? &now == &states_at(detail::MapAccess::table(*grid_), place)
                                  : now.is_all_unknown() && !bricks_.contains(place);
    if (is_as_before) return;
    to_make.insert(place);
    for (int axis = 0; axis < 3; ++axis) {  // their faces depend on what lies beside them
      for (const int step : {-1, 1}) {
        Place beside = place;
        beside[axis] += step;
        if (bricks_.contains(beside)) to_make.insert(beside);
      }
    }
  });
  for (const Place& place : to_make) remake(*grid, place);
  version_ = grid->version();
  grid_ = std::move(grid);
  forget_gone();
}

void GrowingSurface::remake(const VoxelGrid& grid, const Place& place) {
  const BrickTable& table = detail::MapAccess::table(grid);
  const BrickStates& states = states_at(table, place);
  const SurfaceMesh mesh = brick_surface(table, key_of(place));
  Brick& brick = bricks_[place];
  brick.counts = counted(states);
  brick.faces = {mesh.seen.faces, mesh.backs.faces, mesh.frontier.faces};
  const bool has_faces = std::ranges::any_of(brick.faces, [](auto faces) { return faces > 0; });
  if (!has_faces && brick.member == nullptr) {
    if (states.is_all_unknown()) bricks_.erase(place);
    return;
  }
  std::string member = member_of(place, mesh);
  if (brick.member != nullptr && *brick.member == member) return;
  brick.member = std::make_shared<const std::string>(std::move(member));
  brick.version = grid.version();
}

/// What is gone is remembered for readers who have it, but not more of that than what is there.
void GrowingSurface::forget_gone() {
  const auto gone =
      std::ranges::count_if(bricks_, [](const auto& brick) { return brick.second.is_gone(); });
  if (2 * static_cast<std::size_t>(gone) <= bricks_.size()) return;
  first_ = version_;
  for (auto brick = bricks_.begin(); brick != bricks_.end();) {
    Brick& it = brick->second;
    if (it.is_gone()) it.member = nullptr;
    const bool is_known = it.counts.free_voxels + it.counts.occupied_voxels > 0;
    brick = is_known ? std::next(brick) : bricks_.erase(brick);
  }
}

MapCounts GrowingSurface::counts() const {
  MapCounts sum;
  for (const auto& [place, brick] : bricks_) {
    sum.occupied_voxels += brick.counts.occupied_voxels;
    sum.free_voxels += brick.counts.free_voxels;
    sum.certain_voxels += brick.counts.certain_voxels;
    sum.information += brick.counts.information;
  }
  return sum;
}

SharedBytes GrowingSurface::members(std::optional<std::uint64_t> since) const {
  static const auto kComma = std::make_shared<const std::string>(",");
  std::array<std::uint64_t, 3> faces{};
  SharedBytes members;
  for (const auto& [place, brick] : bricks_) {
    for (std::size_t set = 0; set < faces.size(); ++set) faces[set] += brick.faces[set];
    const bool is_wanted = since ? brick.version > *since : !brick.is_gone();
    if (brick.member == nullptr || !is_wanted) continue;
    if (members.size() > 0) members.append(kComma);
    members.append(brick.member);
  }
  if (std::ranges::max(faces) > kMostFaces) refuse_to_draw(kMostFaces, "faces");
  return members;
}

}  // namespace nbvopt
