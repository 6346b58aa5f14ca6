#include "web/surface_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <string>
#include <unordered_map>

#include "map/brick_reader.hpp"
#include "map/brick_table.hpp"
#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using detail::BrickKey;
using detail::BrickStates;
using detail::kBrickBits;
using detail::kBrickSize;

static_assert(kBrickSize == FaceRectangle::kLongest);

/// One bit a voxel of a brick, a row along x in each word.
using BrickBits = std::array<std::uint32_t, detail::kBrickRows>;
/// One bit a face of a plane of a brick: a row along the width in each word.
using PlaneBits = std::array<std::uint32_t, kBrickSize>;

constexpr std::array<FaceNormal, 6> kNormals{FaceNormal::minus_x, FaceNormal::plus_x,
                                             FaceNormal::minus_y, FaceNormal::plus_y,
                                             FaceNormal::minus_z, FaceNormal::plus_z};

constexpr bool is_positive(FaceNormal normal) { return static_cast<int>(normal) % 2 == 1; }

BrickKey beside(BrickKey brick, FaceNormal normal) {
  const int step = is_positive(normal) ? 1 : -1;
  const int axis = axis_of(normal);
  (axis == 0 ? brick.x : axis == 1 ? brick.y : brick.z) += step;
  return brick;
}

/// Of each voxel the bit of its neighbour in a direction, `outer` being the bits of the next brick.
BrickBits neighbours(const BrickBits& own, const BrickBits& outer, FaceNormal normal) {
  constexpr int kLast = kBrickSize - 1;
  const int axis = axis_of(normal);
  const int stride = axis == 1 ? 1 : kBrickSize;  // in rows
  BrickBits shifted;
  for (int row = 0; row < detail::kBrickRows; ++row) {
    if (axis == 0) {
      shifted[row] = is_positive(normal) ? own[row] >> 1 | outer[row] << kLast
                                         : own[row] << 1 | outer[row] >> kLast;
      continue;
    }
    const int place = row / stride % kBrickSize;
    const int across = is_positive(normal) ? stride : -stride;
    const bool leaves = place == (is_positive(normal) ? kLast : 0);
    shifted[row] = leaves ? outer[row - across * kLast] : own[row + across];
  }
  return shifted;
}

/// The faces of a brick in one plane across an axis.
PlaneBits plane_of(const BrickBits& faces, int axis, int place) {
  PlaneBits plane{};
  for (int v = 0; v < kBrickSize; ++v) {
    if (axis == 2) {  // width x, height y
      plane[v] = faces[v | place << kBrickBits];
      continue;
    }
    for (int u = 0; u < kBrickSize; ++u) {
      // Across x the width is y and the height z; across y the width is z and the height x.
      const int row = axis == 0 ? u | v << kBrickBits : place | u << kBrickBits;
      plane[v] |= (faces[row] >> (axis == 0 ? place : v) & 1U) << u;
    }
  }
  return plane;
}

/// Cuts a plane into rectangles: calls visit(u, v, width, height) for each.
template <typename Visit>
void cut_into_rectangles(PlaneBits plane, const Visit& visit) {
  for (int v = 0; v < kBrickSize; ++v) {
    while (plane[v] != 0) {
      const int u = std::countr_zero(plane[v]);
      const int width = std::countr_one(plane[v] >> u);
      const std::uint32_t run =
          (width == kBrickSize ? ~std::uint32_t{0} : (std::uint32_t{1} << width) - 1) << u;
      int height = 0;
      for (; v + height < kBrickSize && (plane[v + height] & run) == run; ++height) {
        plane[v + height] &= ~run;
      }
      visit(u, v, width, height);
    }
  }
}

/// What is no number counts as never seen.
std::uint8_t value_of(float uncertainty) {
  return uncertainty >= 0.0F && uncertainty < 1.0F ? static_cast<std::uint8_t>(uncertainty * 255.0F)
                                                   : std::uint8_t{255};
}

/// Whether two closed ranges meet.
constexpr bool meet(int min_a, int max_a, int min_b, int max_b) {
  return min_a <= max_b && min_b <= max_a;
}

/// Whether a cube of `size` voxels at the multiple `cell` of its size has a voxel of the box.
bool meets(const KeyBox& box, BrickKey cell, int size) {
  return meet(cell.x * size, (cell.x + 1) * size - 1, box.min.x, box.max.x) &&
         meet(cell.y * size, (cell.y + 1) * size - 1, box.min.y, box.max.y) &&
         meet(cell.z * size, (cell.z + 1) * size - 1, box.min.z, box.max.z);
}

/// How many bricks meet the box.
std::uint64_t bricks_in(const KeyBox& box) {
  const auto count = [](int min, int max) {
    return static_cast<std::uint64_t>((max >> kBrickBits) - (min >> kBrickBits) + 1);
  };
  return count(box.min.x, box.max.x) * count(box.min.y, box.max.y) * count(box.min.z, box.max.z);
}

/// The bricks of a tree, each read when it is first asked for.
class TreeBricks {
 public:
  explicit TreeBricks(const UncertaintyOcTree& tree) : tree_(tree) {}

  std::vector<BrickKey> blocks() const { return detail::known_blocks(tree_); }

  /// Bricks of other blocks are asked for as neighbours alone.
  void begin_block() { states_.clear(); }

  /// Null where nothing is known.
  const BrickStates* states(BrickKey brick) {
    const std::uint32_t address = brick.x | brick.y << 11 | brick.z << 22;
    auto found = states_.find(address);
    if (found == states_.end()) {
      found = states_.emplace(address, detail::read_brick(tree_, brick, detail::kAllOctants)).first;
    }
    return found->second.get();
  }

 private:
  const UncertaintyOcTree& tree_;
  std::unordered_map<std::uint32_t, std::shared_ptr<const BrickStates>> states_;
};

/// The bricks of a whole grid.
class GridBricks {
 public:
  explicit GridBricks(const detail::BrickTable& table) : table_(table) {}

  const BrickStates* states(BrickKey brick) const {
    const detail::Brick* ready = table_.ready_brick(brick);
    return ready == nullptr ? nullptr : ready->states.get();
  }

 private:
  const detail::BrickTable& table_;
};

/// Goes through a map brick by brick.
template <typename Bricks>
class Mesher {
 public:
  Mesher(Bricks bricks, const std::optional<KeyBox>& box) : bricks_(std::move(bricks)), box_(box) {}

  SurfaceMesh mesh() {
    constexpr int kBlockSize = 1 << detail::kBlockBits;
    for (const BrickKey& block : bricks_.blocks()) {
      if (box_ && !meets(*box_, block, kBlockSize * kBrickSize)) continue;
      bricks_.begin_block();
      for (int z = 0; z < kBlockSize; ++z) {
        for (int y = 0; y < kBlockSize; ++y) {
          for (int x = 0; x < kBlockSize; ++x) {
            add_brick(
                {block.x * kBlockSize + x, block.y * kBlockSize + y, block.z * kBlockSize + z});
          }
        }
      }
    }
    return std::move(mesh_);
  }

  SurfaceMesh mesh(BrickKey brick) {
    add_brick(brick);
    return std::move(mesh_);
  }

 private:
  /// The states of a brick, all unknown beyond the lattice and where the map has nothing.
  const BrickStates& states(BrickKey brick) {
    static const BrickStates kUnknown;
    constexpr int kBricks = 65536 / kBrickSize;
    const auto is_on_lattice = [](int k) { return k >= 0 && k < kBricks; };
    if (!is_on_lattice(brick.x) || !is_on_lattice(brick.y) || !is_on_lattice(brick.z)) {
      return kUnknown;
    }
    const BrickStates* states = bricks_.states(brick);
    return states == nullptr ? kUnknown : *states;
  }

  /// Leaves of a brick's voxels those in the box.
  void clip(BrickBits& bits, BrickKey brick) const {
    if (!box_) return;
    for (int row = 0; row < detail::kBrickRows; ++row) {
      const int y = brick.y * kBrickSize + row % kBrickSize;
      const int z = brick.z * kBrickSize + row / kBrickSize;
      if (y < box_->min.y || y > box_->max.y || z < box_->min.z || z > box_->max.z) {
        bits[row] = 0;
        continue;
      }
      for (int x = 0; x < kBrickSize; ++x) {
        const int key = brick.x * kBrickSize + x;
        if (key < box_->min.x || key > box_->max.x) bits[row] &= ~(std::uint32_t{1} << x);
      }
    }
  }

  void add_brick(BrickKey brick) {
    if (box_ && !meets(*box_, brick, kBrickSize)) return;
    const BrickStates& own = states(brick);
    if (own.is_all_unknown()) return;
    for (const FaceNormal normal : kNormals) {
      const BrickStates& next = states(beside(brick, normal));
      const BrickBits next_occupied = neighbours(own.occupied, next.occupied, normal);
      const BrickBits next_free = neighbours(own.free, next.free, normal);
      BrickBits seen;
      BrickBits backs;
      BrickBits frontier;
      for (int row = 0; row < detail::kBrickRows; ++row) {
        seen[row] = own.occupied[row] & next_free[row];
        backs[row] = own.occupied[row] & ~next_free[row] & ~next_occupied[row];
        frontier[row] = own.free[row] & ~next_free[row] & ~next_occupied[row];
      }
      if (own.has_occupied) {
        add_faces(mesh_.seen, seen, brick, normal, &own);
        add_faces(mesh_.backs, backs, brick, normal, &own);
      }
      if (own.has_free) add_faces(mesh_.frontier, frontier, brick, normal, nullptr);
    }
  }

  /// `values_of` holds u of the faces' voxels; null for faces without values.
  void add_faces(FaceSet& set, BrickBits& faces, BrickKey brick, FaceNormal normal,
                 const BrickStates* values_of) {
    clip(faces, brick);
    const int axis = axis_of(normal);
    for (int place = 0; place < kBrickSize; ++place) {
      cut_into_rectangles(plane_of(faces, axis, place), [&](int u, int v, int width, int height) {
        std::array<int, 3> least{brick.x * kBrickSize, brick.y * kBrickSize, brick.z * kBrickSize};
        least[axis] += place;
        least[(axis + 1) % 3] += u;
        least[(axis + 2) % 3] += v;
        const FaceRectangle rectangle{
            {static_cast<std::uint16_t>(least[0]), static_cast<std::uint16_t>(least[1]),
             static_cast<std::uint16_t>(least[2])},
            normal,
            static_cast<std::uint8_t>(width),
            static_cast<std::uint8_t>(height)};
        set.rectangles.push_back(rectangle);
        set.faces += static_cast<std::uint64_t>(width) * height;
        if (values_of == nullptr) return;
        for_each_face(rectangle, [&](VoxelKey key) {
          set.values.push_back(
              value_of(values_of->uncertainty_of_occupied(key, kUnknownUncertainty)));
        });
      });
    }
    if (set.faces > kMostFaces) refuse_to_draw(kMostFaces, "faces");
  }

  Bricks bricks_;
  const std::optional<KeyBox> box_;
  SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh surface_mesh(const UncertaintyMap& map, const std::optional<KeyBox>& box) {
  const std::uint64_t bricks = map.known_bricks();
  if ((box ? std::min(bricks, bricks_in(*box)) : bricks) > kMostBricks) {
    refuse_to_draw(kMostBricks, "bricks of 32 x 32 x 32 voxels");
  }
  return Mesher(TreeBricks(detail::MapAccess::tree(map)), box).mesh();
}

SurfaceMesh brick_surface(const detail::BrickTable& grid, BrickKey brick) {
  return Mesher(GridBricks(grid), std::nullopt).mesh(brick);
}

void refuse_to_draw(std::uint64_t most, const char* things) {
  throw InputError("the map is too large to be drawn as a whole, it has more than " +
                   std::to_string(most) + " " + things + ": choose a smaller box of it");
}

}  // namespace nbvopt
