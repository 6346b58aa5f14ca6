// Windows of 8 x 8 voxels of a layer as bits: bit 8 r + c is column c, counted along the
// layer's row axis, of row r.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "gain/cone_grid.hpp"

namespace nbvopt::detail {

constexpr int kWindow = ConeGrid::kWindow;
constexpr std::uint64_t kWindowRow = 0xFF;
constexpr std::uint64_t kWindowColumn = 0x0101010101010101;

/// Bits of the columns first to last of each row.
inline std::uint64_t window_columns(int first, int last) {
  first = std::max(first, 0);
  last = std::min(last, kWindow - 1);
  if (first > last) return 0;
  return ((kWindowRow >> (kWindow - 1 - (last - first))) << first) * kWindowColumn;
}

/// Bits of the rows first to last.
inline std::uint64_t window_rows(int first, int last) {
  first = std::max(first, 0);
  last = std::min(last, kWindow - 1);
  if (first > last) return 0;
  return (~std::uint64_t{0} >> (8 * (kWindow - 1 - (last - first)))) << (8 * first);
}

inline std::uint64_t next_column(std::uint64_t window) { return (window << 1) & ~kWindowColumn; }
inline std::uint64_t previous_column(std::uint64_t window) {
  return (window >> 1) & ~(kWindowColumn << 7);
}

/// The window seen from a place that is so many columns and rows further on.
inline std::uint64_t moved(std::uint64_t window, int by_columns, int by_rows) {
  if (std::abs(by_columns) >= kWindow || std::abs(by_rows) >= kWindow) return 0;
  for (; by_columns > 0; --by_columns) window = previous_column(window);
  for (; by_columns < 0; ++by_columns) window = next_column(window);
  return by_rows >= 0 ? window >> (8 * by_rows) : window << (-8 * by_rows);
}

}  // namespace nbvopt::detail
