// Codes by bit-parallel erosion: the brick and a margin of 16 voxels all around are 64 x 64 rows
// of 64 bits, a set bit being a free voxel. Eroding by a cube of radius r keeps the voxels whose
// cube is free.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "map/brick_codes.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <cstring>

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
  for (std::size_t i = 0; i < in.size(); i += hn::Lanes(d)) {
    const auto row = hn::LoadU(d, &in[i]);
    hn::StoreU(hn::And(row, hn::And(hn::ShiftLeftSame(row, shift), hn::ShiftRightSame(row, shift))),
               d, &along_x[i]);
  }
  and_three(along_x, by, in.size() - by, by, along_y);
  and_three(along_y, radius * kWindow, in.size() - radius * kWindow, by * kWindow, out);
}

/// One byte a voxel from five bit planes.
void expand(const std::array<BitWindow, 1 + kErosions.size()>& sets, std::uint8_t* code) {
  const hn::CappedTag<std::uint8_t, kBrickSize> d;
  const std::size_t lanes = hn::Lanes(d);
  constexpr int kPlanes = 5;
  for (int z = 0; z < kBrickSize; ++z) {
    for (int y = 0; y < kBrickSize; ++y) {
      const std::size_t row = static_cast<std::size_t>((z + kCodeReach) * kWindow + y + kCodeReach);
      // The sets are nested, so bit b of a voxel's code is the parity of the sets that hold it
      // and whose code differs in bit b from the one before.
      std::array<std::uint32_t, kPlanes> plane{};
      int previous = 0;
      for (std::size_t i = 0; i < sets.size(); ++i) {
        const auto bits = static_cast<std::uint32_t>(sets[i][row] >> kCodeReach);
        const int value = 1 + (i == 0 ? 0 : static_cast<int>(kErosions[i - 1].radius));
        for (int b = 0; b < kPlanes; ++b) {
          if (((value ^ previous) >> b & 1) != 0) plane[b] ^= bits;
        }
        previous = value;
      }
      for (std::size_t x = 0; x < kBrickSize; x += lanes) {
        auto value = hn::Zero(d);
        for (int b = 0; b < kPlanes; ++b) {
          // LoadMaskBits reads eight bytes.
          alignas(8) const std::uint64_t bits = plane[b] >> x;
          const auto mask = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits));
          value = hn::Or(value, hn::IfThenElseZero(mask, hn::Set(d, std::uint8_t(1U << b))));
        }
        hn::StoreU(value, d, code + (z * kBrickSize + y) * kBrickSize + x);
      }
    }
  }
}

void compute_free_codes(const BitWindow& free, std::uint8_t* code) {
  std::array<BitWindow, 1 + kErosions.size()> sets{};
  BitWindow along_x{}, along_y{};
  sets[0] = free;
  for (std::size_t i = 0; i < kErosions.size(); ++i) {
    const Erosion& e = kErosions[i];
    erode(sets[e.from], e.by, e.radius, along_x, along_y, sets[i + 1]);
  }
  expand(sets, code);
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(compute_free_codes);

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

}  // namespace

void compute_codes(const BrickNeighbourhood& neighbourhood, std::uint8_t* code) {
  const BrickStates& own = *neighbourhood[13];
  alignas(64) std::array<std::uint8_t, kBrickVoxels> by_row;
  HWY_DYNAMIC_DISPATCH(compute_free_codes)(free_window(neighbourhood), by_row.data());
  for (int row = 0; row < kBrickRows; ++row) {
    std::uint8_t* const row_code = &by_row[row * kBrickSize];
    for (std::uint32_t left = ~own.free[row]; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      row_code[x] = (own.occupied[row] >> x & 1U) != 0 ? kOccupiedCode : kUnknownCode;
    }
  }
  // Four voxels along x stay together.
  for (int row = 0; row < kBrickRows; ++row) {
    for (int x = 0; x < kBrickSize; x += 4) {
      const VoxelKey key{static_cast<std::uint16_t>(x),
                         static_cast<std::uint16_t>(row & kBrickMask),
                         static_cast<std::uint16_t>(row >> kBrickBits)};
      std::memcpy(code + code_index(key), &by_row[row * kBrickSize + x], 4);
    }
  }
}

}  // namespace nbvopt::detail
#endif
