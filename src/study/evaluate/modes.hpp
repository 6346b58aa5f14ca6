// What a view that was chosen by one measure of uncertainty is worth by another.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "study/results.hpp"

namespace nbvopt::study {

/// Modes in the order of Run::gain_by_mode: distance, angle, both.
struct ModeTable {
  /// [chosen][judged]: the mean gain, as `judged` counts, of answers chosen under `chosen`, over
  /// that of the answers chosen under `judged` itself. 1 on the diagonal; NaN where no question was
  /// answered under both modes or the latter answers gain nothing.
  std::array<std::array<double, 3>, 3> ratio{};
  /// How many pairs of answers, to one question by one seed, stand behind it.
  std::array<std::array<std::size_t, 3>, 3> pairs{};
};

/// The place of a mode in Run::gain_by_mode.
std::size_t mode_index(UncertaintyMode mode);

/// From the answers of the first solver with the loosest budget; none where all cases have one
/// mode.
std::optional<ModeTable> compare_modes(const Results& results);

}  // namespace nbvopt::study
