// The paper's Tables 1 and 2, as printed: what the reproduction is held against.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace nbvopt {

/// One test type's row in both tables; percentages are those against the 2D test.
struct PaperFigures {
  int voxels;
  double voxels_percent;
  int information;
  int gain;
  double gain_percent;
  int duration_s;
  double time_percent;
  int voxels_per_s;
  int information_per_s;
};

/// The times t, in seconds, that the paper tries its optimisation with.
inline constexpr std::array kPaperMotionTimes_s{0.2, 0.5, 1.0};

/// The five tests of one environment, in the tables' order.
struct PaperEnvironment {
  std::string_view name;
  std::string_view size_m;
  PaperFigures planar;                                             ///< "2D": a still camera
  std::array<PaperFigures, kPaperMotionTimes_s.size()> optimised;  ///< one a t
  PaperFigures spatial;                                            ///< "3D"
};

/// All six environments, in the tables' order.
std::span<const PaperEnvironment> paper_tables();

}  // namespace nbvopt
