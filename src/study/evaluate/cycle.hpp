// How much gain a robot collects a second when it plans and moves in turn.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/results.hpp"

namespace nbvopt::study {

/// Over the runs with the loosest budget; NaN without runs. Gains a second are the gain of all runs
/// over the time of all, as a robot that does one after the other collects it: a mean of quotients
/// would be ruled by the answers that hardly move. A failed run gains nothing and takes the whole
/// motion time.
struct Cycle {
  std::size_t solver = 0;
  double motion_time_s = 0.0;
  std::size_t runs = 0;
  double mean_gain = 0.0;
  double mean_move_time_s = 0.0;  ///< of the answers
  /// Gain over computing and the answers' own motion, as in the paper.
  double gain_per_s_moving = 0.0;
  /// Gain over computing and the whole motion time: of a robot that waits for the end of the slot.
  /// NaN where the motion time is 0, which has no end.
  double gain_per_s_waiting = 0.0;
  /// The same of what answers gain more than staying: what moving is worth. A first look from a
  /// new place gains much wherever the camera looks, and short motion times have many of them.
  double added_per_s_waiting = 0.0;
};

/// A row for every solver and motion time, in this order, motion times ascending.
std::vector<Cycle> cycles(const Results& results);

/// The motion time with the greatest gain a second in a map, in the three meanings of Cycle;
/// the shortest of equal ones. NaN where there is none.
struct BestMotionTime {
  std::size_t solver = 0;
  std::string map;
  double moving_s = 0.0;
  double waiting_s = 0.0;
  double adding_s = 0.0;
};

/// A row for every solver and map, in this order, maps in the order of the cases.
std::vector<BestMotionTime> best_motion_times(const Results& results);

}  // namespace nbvopt::study
