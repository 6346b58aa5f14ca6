// Codes by bit-parallel erosion: the brick and a margin of 16 voxels all around are 64 x 64 rows
// of 64 bits, a set bit being a free voxel. Eroding by a cube of radius r keeps the voxels whose
// cube is free.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "map/brick_codes.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <cstring>
#include <utility>

#include "map/brick.hpp"

#ifndef NBVOPT_MAP_BRICK_CODES_ONCE
#define NBVOPT_MAP_BRICK_CODES_ONCE
namespace nbvopt::detail {

inline constexpr int kWindow = kBrickSize + 2 * kCodeReach;
static_assert(kWindow == 64, "a row of the window is one 64-bit word");

/// Rows of the window, y running fastest.
using BitWindow = std::array<std::uint64_t, kWindow * kWindow>;

/// The bits of a brick's voxels that tell of their neighbours, a word a row.
struct EdgeRows {
  std::array<std::uint32_t, kBrickRows> first;   ///< kBesideSurfaceBit or kFrontierBit
  std::array<std::uint32_t, kBrickRows> second;  ///< kFrontierBesideSurfaceBit
};

/// How the eroded sets follow from each other: set i is set `from` eroded by `by` more voxels.
/// Two erosions by radius r and s make one by r + s; a set already eroded by R may be eroded by
/// s <= 2 R + 1 with three samples an axis, since cubes of radius R that far apart still touch.
struct Erosion {
  std::size_t from;
  std::size_t by;
  std::size_t radius;
};
inline constexpr std::array<Erosion, 8> kErosions{{{0, 1, 1},
                                                   {1, 1, 2},
                                                   {1, 2, 3},
                                                   {1, 3, 4},
                                                   {4, 2, 6},
                                                   {4, 4, 8},
                                                   {4, 8, 12},
                                                   {6, 8, kCodeReach}}};

}  // namespace nbvopt::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Each row and those `stride` before and after it, of the rows from `begin` to `end`.
HWY_INLINE void and_three(const BitWindow& in, std::size_t begin, std::size_t end,
                          std::size_t stride, BitWindow& out) {
  const hn::ScalableTag<std::uint64_t> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    const auto kept = hn::And(hn::LoadU(d, &in[i]), hn::And(hn::LoadU(d, &in[i - stride]),
                                                            hn::LoadU(d, &in[i + stride])));
    hn::StoreU(kept, d, &out[i]);
  }
  for (; i < end; ++i) out[i] = in[i] & in[i - stride] & in[i + stride];
}

/// Erodes by `by` more voxels, `radius` in total. What lies nearer to the window's edge than that
/// is not valid, and not needed.
void erode(const BitWindow& in, std::size_t by, std::size_t radius, BitWindow& along_x,
           BitWindow& along_y, BitWindow& out) {
  const hn::ScalableTag<std::uint64_t> d;
  const int shift = static_cast<int>(by);
  // Rows that are valid in `in`.
  const std::size_t begin = (radius - by) * kWindow;
  const std::size_t end = in.size() - begin;
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const auto row = hn::LoadU(d, &in[i]);
    hn::StoreU(hn::And(row, hn::And(hn::ShiftLeftSame(row, shift), hn::ShiftRightSame(row, shift))),
               d, &along_x[i]);
  }
  and_three(along_x, begin + by, end - by, by, along_y);
  and_three(along_y, radius * kWindow, in.size() - radius * kWindow, by * kWindow, out);
}

/// Bits of a code: five for a free voxel's leap, then those of the edge of what is known, of which
/// the second is that of occupied voxels as well, then not free.
constexpr int kLeapBits = 5;
constexpr int kCodeBits = 8;

/// The bits in which the code of a voxel in set i differs from that of one in set i - 1 only.
constexpr int toggled_bits(std::size_t set) {
  if (set == 0) return 1;
  const std::size_t before = set == 1 ? 0 : kErosions[set - 2].radius;
  return static_cast<int>((1 + kErosions[set - 1].radius) ^ (1 + before));
}

/// One bit plane of the codes, a word a row of the brick.
using BitPlane = std::array<std::uint64_t, kBrickRows>;

/// The sets are nested, so bit b of a free voxel's code is the parity of those sets that hold the
/// voxel and toggle bit b.
template <std::size_t... kSet>
HWY_INLINE void leap_planes(const std::array<BitWindow, 1 + kErosions.size()>& sets,
                            std::array<BitPlane, kLeapBits>& planes, std::index_sequence<kSet...>) {
  const hn::CappedTag<std::uint64_t, 8> d;
  for (int z = 0; z < kBrickSize; ++z) {
    for (int y = 0; y < kBrickSize; y += static_cast<int>(hn::Lanes(d))) {
      const std::size_t row = static_cast<std::size_t>((z + kCodeReach) * kWindow + y + kCodeReach);
      for (int b = 0; b < kLeapBits; ++b) {
        auto plane = hn::Zero(d);
        const auto toggle = [&](std::size_t set, int bits) HWY_ATTR {
          if ((bits >> b & 1) != 0) plane = hn::Xor(plane, hn::LoadU(d, &sets[set][row]));
        };
        (toggle(kSet, toggled_bits(kSet)), ...);
        hn::StoreU(hn::ShiftRight<kCodeReach>(plane), d, &planes[b][z * kBrickSize + y]);
      }
    }
  }
}

/// One byte a voxel, in the order of code_index().
void expand(const std::array<BitPlane, kLeapBits>& leap, const EdgeRows& edge,
            const BrickStates& states, std::uint8_t* code) {
  const hn::CappedTag<std::uint8_t, kBrickSize> d;
  for (int row = 0; row < kBrickRows; ++row) {
    std::array<std::uint64_t, kCodeBits> bits{};
    for (int b = 0; b < kLeapBits; ++b) bits[b] = leap[b][row];
    bits[5] = edge.first[row];
    bits[6] = states.occupied[row] | edge.second[row];
    bits[7] = ~states.free[row];
    alignas(32) std::array<std::uint8_t, kBrickSize> codes;
    for (std::size_t x = 0; x < kBrickSize; x += hn::Lanes(d)) {
      auto value = hn::Zero(d);
      for (int b = 0; b < kCodeBits; ++b) {
        const std::uint64_t word = bits[b] >> x;  // LoadMaskBits reads eight bytes
        const auto mask = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&word));
        value = hn::Or(value, hn::IfThenElseZero(mask, hn::Set(d, std::uint8_t(1U << b))));
      }
      hn::StoreU(value, d, &codes[x]);
    }
    for (int x = 0; x < kBrickSize; x += 4) {  // four voxels along x stay together
      const VoxelKey key{static_cast<std::uint16_t>(x),
                         static_cast<std::uint16_t>(row & kBrickMask),
                         static_cast<std::uint16_t>(row >> kBrickBits)};
      std::memcpy(code + code_index(key), &codes[x], 4);
    }
  }
}

void compute_window_codes(const BitWindow& free, const EdgeRows& edge, const BrickStates& states,
                          std::uint8_t* code) {
  // Kept a thread: what is written anew needs no clearing.
  thread_local std::array<BitWindow, 1 + kErosions.size()> sets;
  thread_local BitWindow along_x, along_y;
  sets[0] = free;
  for (std::size_t i = 0; i < kErosions.size(); ++i) {
    const Erosion& e = kErosions[i];
    erode(sets[e.from], e.by, e.radius, along_x, along_y, sets[i + 1]);
  }
  std::array<BitPlane, kLeapBits> leap;
  leap_planes(sets, leap, std::make_index_sequence<1 + kErosions.size()>());
  expand(leap, edge, states, code);
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(compute_window_codes);

namespace {

BitWindow free_window(const BrickNeighbourhood& neighbourhood) {
  BitWindow window;
  for (int z = 0; z < kWindow; ++z) {
    const int key_z = z + kBrickSize - kCodeReach;  // counted from the lower neighbour's start
    for (int y = 0; y < kWindow; ++y) {
      const int key_y = y + kBrickSize - kCodeReach;
      const int row = (key_y & kBrickMask) | (key_z & kBrickMask) << kBrickBits;
      const BrickStates* const* three =
          &neighbourhood[3 * (key_y >> kBrickBits) + 9 * (key_z >> kBrickBits)];
      window[z * kWindow + y] = std::uint64_t{three[0]->free[row]} >> (kBrickSize - kCodeReach) |
                                std::uint64_t{three[1]->free[row]} << kCodeReach |
                                std::uint64_t{three[2]->free[row]} << (kBrickSize + kCodeReach);
    }
  }
  return window;
}

/// The brick with one voxel more all around: rows of 34 bits, y running fastest.
constexpr int kRim = kBrickSize + 2;
using RimRows = std::array<std::uint64_t, kRim * kRim>;

/// Where a voxel is occupied, and where it is unknown.
void fill_rim(const BrickNeighbourhood& neighbourhood, RimRows& occupied, RimRows& unknown) {
  for (int z = 0; z < kRim; ++z) {
    const int key_z = z + kBrickSize - 1;  // counted from the lower neighbour's start
    for (int y = 0; y < kRim; ++y) {
      const int key_y = y + kBrickSize - 1;
      const int row = (key_y & kBrickMask) | (key_z & kBrickMask) << kBrickBits;
      const BrickStates* const* three =
          &neighbourhood[3 * (key_y >> kBrickBits) + 9 * (key_z >> kBrickBits)];
      const auto joined = [&](const auto& bits_of) {
        return std::uint64_t{bits_of(*three[0])} >> (kBrickSize - 1) |
               std::uint64_t{bits_of(*three[1])} << 1 |
               std::uint64_t{bits_of(*three[2]) & 1U} << (kBrickSize + 1);
      };
      occupied[z * kRim + y] = joined([&](const BrickStates& s) { return s.occupied[row]; });
      unknown[z * kRim + y] =
          joined([&](const BrickStates& s) { return ~(s.occupied[row] | s.free[row]); });
    }
  }
}

/// The voxels of which a face neighbour is set.
std::uint32_t with_neighbour(const RimRows& rows, int i) {
  const std::uint64_t any =
      rows[i] << 1 | rows[i] >> 1 | rows[i - 1] | rows[i + 1] | rows[i - kRim] | rows[i + kRim];
  return static_cast<std::uint32_t>(any >> 1);
}

EdgeRows edge_rows(const BrickNeighbourhood& neighbourhood) {
  thread_local RimRows occupied, unknown;
  fill_rim(neighbourhood, occupied, unknown);
  const BrickStates& states = *neighbourhood[13];
  EdgeRows edge;
  for (int row = 0; row < kBrickRows; ++row) {
    const int i = (row >> kBrickBits) * kRim + kRim + (row & kBrickMask) + 1;
    const std::uint32_t beside_surface = with_neighbour(occupied, i);
    const std::uint32_t frontier = states.free[row] & with_neighbour(unknown, i);
    edge.first[row] = frontier | (beside_surface & ~(states.free[row] | states.occupied[row]));
    edge.second[row] = frontier & beside_surface;
  }
  return edge;
}

}  // namespace

void compute_codes(const BrickNeighbourhood& neighbourhood, std::uint8_t* code) {
  HWY_DYNAMIC_DISPATCH(compute_window_codes)
  (free_window(neighbourhood), edge_rows(neighbourhood), *neighbourhood[13], code);
}

}  // namespace nbvopt::detail
#endif
