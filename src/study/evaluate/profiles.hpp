// How many questions a solver has answered within a cost.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "study/results.hpp"

namespace nbvopt::study {

/// The distribution of a cost over questions, some of which are never answered.
struct Profile {
  std::vector<double> costs;  ///< of the questions that were answered, ascending
  std::size_t questions = 0;

  /// The share of all questions that was answered within a cost; NaN where none was asked.
  double share_within(double cost) const;
  double share_answered() const;
};

/// A solver's.
struct SolverProfiles {
  Profile evaluations;
  Profile time_ms;
};

/// The performance profiles of Dolan and More (2002): a question is a case and seed, answered when
/// the run with the loosest budget reaches `target` times the best gain, and the cost is that of
/// cost_to_reach() over the least cost of any solver there. One entry a solver; a solver is asked
/// where it has a run and the case a reference.
std::vector<SolverProfiles> performance_profiles(const Results& results, double target);

/// 41 shares of the best gain whose rests are equally spaced in logarithm from 0.3 to 0.001.
std::vector<double> data_profile_targets();

/// The empirical runtime distributions of COCO: a question is a run with the loosest budget and a
/// target, and the cost is that of cost_to_reach(). One entry a solver.
std::vector<SolverProfiles> data_profiles(const Results& results,
                                          const std::vector<double>& targets);

/// The least and the greatest cost of all solvers in one of the two units; 1 and 1 where nobody
/// reached anything.
std::array<double, 2> cost_range(const std::vector<SolverProfiles>& profiles,
                                 Profile SolverProfiles::*unit);

}  // namespace nbvopt::study
