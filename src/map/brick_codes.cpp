// Codes by bit-parallel erosion: the brick and a margin of 16 voxels all around are 64 x 64 rows
// of 64 bits, a set bit being a free voxel. Eroding by a cube of radius r keeps the voxels whose
// cube is free.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "map/brick_codes.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
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

/// How the eroded sets follow from each other: set i is set `from` eroded by `by` more voxels.
/// Two erosions by radius r and s make one by r + s; a set already eroded by R may be eroded by
/// s <= 2 R + 1 with three samples an axis, since cubes of radius R that far apart still touch.
struct Erosion {
  std::size_t from;
  int by;
  int radius;
};
inline constexpr std::array<Erosion, 8> kErosions{{{0, 1, 1},
                                                   {1, 1, 2},
                                                   {1, 2, 3},
                                                   {1, 3, 4},
                                                   {4, 2, 6},
                                                   {4, 4, 8},
                                                   {4, 8, 12},
                                                   {6, 8, kCodeReach}}};

/// How far around the brick a set must be known, for those that follow from it.
constexpr int margin_of(std::size_t set) {
  int margin = 0;
  for (std::size_t i = 0; i < kErosions.size(); ++i) {
    if (kErosions[i].from == set) margin = std::max(margin, kErosions[i].by + margin_of(i + 1));
  }
  return margin;
}
static_assert(margin_of(0) == kCodeReach);

}  // namespace nbvopt::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rows are taken some at once, which divide this many.
constexpr int kStep = 8;
constexpr hn::CappedTag<std::uint64_t, kStep> d_rows;
constexpr hn::Rebind<std::uint32_t, decltype(d_rows)> d_half;
constexpr int down_to_step(int row) { return row / kStep * kStep; }
template <class D>
HWY_INLINE int lanes_of(D d) {
  return static_cast<int>(hn::Lanes(d));
}

/// Fills rows [begin, end) of the window, along y and z, with one kind of the voxels' bits.
void fill_window(const BrickNeighbourhood& neighbourhood,
                 std::array<std::uint32_t, kBrickRows> BrickStates::*bits, int begin, int end,
                 BitWindow& window) {
  for (int z = begin; z < end; ++z) {
    const int key_z = z + kBrickSize - kCodeReach;  // counted from the lower neighbour's start
    for (int y = down_to_step(begin); y < end; y += lanes_of(d_rows)) {
      const int key_y = y + kBrickSize - kCodeReach;
      const int row = (key_y & kBrickMask) | (key_z & kBrickMask) << kBrickBits;
      const BrickStates* const* three =
          &neighbourhood[3 * (key_y >> kBrickBits) + 9 * (key_z >> kBrickBits)];
      const auto rows_of = [&](int i) HWY_ATTR {
        return hn::PromoteTo(d_rows, hn::LoadU(d_half, &(three[i]->*bits)[row]));
      };
      const auto joined = hn::Or(hn::ShiftRight<kBrickSize - kCodeReach>(rows_of(0)),
                                 hn::Or(hn::ShiftLeft<kCodeReach>(rows_of(1)),
                                        hn::ShiftLeft<kBrickSize + kCodeReach>(rows_of(2))));
      hn::Store(joined, d_rows, &window[z * kWindow + y]);
    }
  }
}

/// Erodes as `e` says, as far as the brick and a margin around it.
void erode(const BitWindow& in, const Erosion& e, int margin, BitWindow& out) {
  const int begin = kCodeReach - margin;
  const int end = kWindow - begin;
  const int y_begin = down_to_step(begin);
  const int y_end = kWindow - y_begin;
  alignas(64) std::array<std::uint64_t, kWindow + 2 * kStep> along_x{};  // of one z
  alignas(64) BitWindow along_y;
  static_assert(kErosions[7].by == kStep && kErosions[6].by == kStep);
  for (int z = begin - e.by; z < end + e.by; ++z) {
    const auto* rows = &in[z * kWindow];
    for (int y = std::max(y_begin - kStep, 0); y < std::min(y_end + kStep, kWindow);
         y += lanes_of(d_rows)) {
      const auto row = hn::Load(d_rows, &rows[y]);
      const auto beside = hn::And(hn::ShiftLeftSame(row, e.by), hn::ShiftRightSame(row, e.by));
      hn::Store(hn::And(row, beside), d_rows, &along_x[kStep + y]);
    }
    for (int y = y_begin; y < y_end; y += lanes_of(d_rows)) {
      const auto at = [&](int dy) HWY_ATTR { return hn::LoadU(d_rows, &along_x[kStep + y + dy]); };
      hn::Store(hn::And(at(0), hn::And(at(-e.by), at(e.by))), d_rows, &along_y[z * kWindow + y]);
    }
  }
  for (int z = begin; z < end; ++z) {
    for (int y = y_begin; y < y_end; y += lanes_of(d_rows)) {
      const auto at = [&](int dz)
                          HWY_ATTR { return hn::Load(d_rows, &along_y[(z + dz) * kWindow + y]); };
      hn::Store(hn::And(at(0), hn::And(at(-e.by), at(e.by))), d_rows, &out[z * kWindow + y]);
    }
  }
}

/// Bits of a code: five for a free voxel's leap, then those of the edge of what is known, of which
/// the second is that of occupied voxels as well, then not free.
constexpr int kLeapBits = 5;
constexpr int kCodeBits = 8;

/// The bits in which the code of a voxel in set i differs from that of one in set i - 1 only.
constexpr int toggled_bits(std::size_t set) {
  if (set == 0) return 1;
  const int before = set == 1 ? 0 : kErosions[set - 2].radius;
  return (1 + kErosions[set - 1].radius) ^ (1 + before);
}

/// The bits of the brick's voxels, a plane a bit of their codes, a word a row.
using BitPlanes = std::array<std::array<std::uint64_t, kBrickRows>, kCodeBits>;

/// Visits the brick's rows: their place in the planes and in the window.
template <class Visit>
HWY_INLINE void for_each_rows(const Visit& visit) {
  for (int z = 0; z < kBrickSize; ++z) {
    for (int y = 0; y < kBrickSize; y += lanes_of(d_rows)) {
      visit(z * kBrickSize + y, (z + kCodeReach) * kWindow + y + kCodeReach);
    }
  }
}

/// The sets are nested, so bit b of a free voxel's code is the parity of those sets that hold the
/// voxel and toggle bit b.
template <std::size_t... kSet>
HWY_INLINE void fill_leap_planes(const std::array<BitWindow, 1 + kErosions.size()>& sets,
                                 BitPlanes& planes, std::index_sequence<kSet...>) {
  for_each_rows([&](int place, int row) HWY_ATTR {
    for (int b = 0; b < kLeapBits; ++b) {
      auto plane = hn::Zero(d_rows);
      const auto toggle = [&](std::size_t set, int bits) HWY_ATTR {
        if ((bits >> b & 1) != 0) plane = hn::Xor(plane, hn::Load(d_rows, &sets[set][row]));
      };
      (toggle(kSet, toggled_bits(kSet)), ...);
      hn::Store(hn::ShiftRight<kCodeReach>(plane), d_rows, &planes[b][place]);
    }
  });
}

/// The voxels of which a face neighbour is set.
HWY_INLINE hn::Vec<decltype(d_rows)> with_neighbour(const BitWindow& window, int row) {
  const auto at = [&](int i) HWY_ATTR { return hn::LoadU(d_rows, &window[row + i]); };
  const auto along_x = hn::Or(hn::ShiftLeft<1>(at(0)), hn::ShiftRight<1>(at(0)));
  return hn::Or(along_x, hn::Or(hn::Or(at(-1), at(1)), hn::Or(at(-kWindow), at(kWindow))));
}

/// The planes that tell of voxels' neighbours and states.
void fill_edge_planes(const BrickNeighbourhood& neighbourhood, const BitWindow& free,
                      BitPlanes& planes) {
  constexpr int kBegin = kCodeReach - 1;
  constexpr int kEnd = kWindow - kBegin;
  alignas(64) BitWindow occupied, unknown;
  fill_window(neighbourhood, &BrickStates::occupied, kBegin, kEnd, occupied);
  for (int z = kBegin; z < kEnd; ++z) {
    for (int y = down_to_step(kBegin); y < kEnd; y += lanes_of(d_rows)) {
      const int row = z * kWindow + y;
      const auto known = hn::Or(hn::Load(d_rows, &free[row]), hn::Load(d_rows, &occupied[row]));
      hn::Store(hn::Not(known), d_rows, &unknown[row]);
    }
  }
  for_each_rows([&](int place, int row) HWY_ATTR {
    const auto beside_surface = with_neighbour(occupied, row);
    const auto is_free = hn::Load(d_rows, &free[row]);
    const auto frontier = hn::And(is_free, with_neighbour(unknown, row));
    const auto store = [&](int b, auto bits) HWY_ATTR {
      hn::Store(hn::ShiftRight<kCodeReach>(bits), d_rows, &planes[b][place]);
    };
    store(5, hn::Or(frontier, hn::And(beside_surface, hn::Load(d_rows, &unknown[row]))));
    store(6, hn::Or(hn::Load(d_rows, &occupied[row]), hn::And(frontier, beside_surface)));
    store(7, hn::Not(is_free));
  });
}

/// One byte a voxel, in the order of code_index().
void expand(const BitPlanes& planes, std::uint8_t* code) {
  const hn::CappedTag<std::uint8_t, kBrickSize> d;
  for (int row = 0; row < kBrickRows; ++row) {
    alignas(32) std::array<std::uint8_t, kBrickSize> codes;
    for (int x = 0; x < kBrickSize; x += lanes_of(d)) {
      auto value = hn::Zero(d);
      for (int b = 0; b < kCodeBits; ++b) {
        const std::uint64_t word = planes[b][row] >> x;  // LoadMaskBits reads eight bytes
        const auto mask = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&word));
        value = hn::Or(value, hn::IfThenElseZero(mask, hn::Set(d, std::uint8_t(1U << b))));
      }
      hn::Store(value, d, &codes[x]);
    }
    for (int x = 0; x < kBrickSize; x += 4) {  // four voxels along x stay together
      const VoxelKey key{static_cast<std::uint16_t>(x),
                         static_cast<std::uint16_t>(row & kBrickMask),
                         static_cast<std::uint16_t>(row >> kBrickBits)};
      std::memcpy(code + code_index(key), &codes[x], 4);
    }
  }
}

template <std::size_t... kErosion>
HWY_INLINE void erode_all(std::array<BitWindow, 1 + kErosions.size()>& sets,
                          std::index_sequence<kErosion...>) {
  (erode(sets[kErosions[kErosion].from], kErosions[kErosion], margin_of(kErosion + 1),
         sets[kErosion + 1]),
   ...);
}

void compute_all_codes(const BrickNeighbourhood& neighbourhood, std::uint8_t* code) {
  // Kept a thread: what is written anew needs no clearing.
  alignas(64) thread_local std::array<BitWindow, 1 + kErosions.size()> sets;
  alignas(64) thread_local BitPlanes planes;
  fill_window(neighbourhood, &BrickStates::free, 0, kWindow, sets[0]);
  erode_all(sets, std::make_index_sequence<kErosions.size()>());
  fill_leap_planes(sets, planes, std::make_index_sequence<1 + kErosions.size()>());
  fill_edge_planes(neighbourhood, sets[0], planes);
  expand(planes, code);
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(compute_all_codes);

void compute_codes(const BrickNeighbourhood& neighbourhood, std::uint8_t* code) {
  HWY_DYNAMIC_DISPATCH(compute_all_codes)(neighbourhood, code);
}

}  // namespace nbvopt::detail
#endif
