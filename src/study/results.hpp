// What a study found: every run of every solver, as its report reads it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt::study {

/// A question that every solver was asked: a robot that stands somewhere in a map.
struct CaseResult {
  std::string map;        ///< the file's name
  std::size_t start = 0;  ///< its number among the map's
  double motion_time_s = 0.0;
  UncertaintyMode mode = UncertaintyMode::both;
  /// What answers are measured against, NaN where it is not known: one of the next two.
  double reference_gain = std::numeric_limits<double>::quiet_NaN();
  /// The best exact gain that the reference search found; NaN where it has not run.
  double best_known = std::numeric_limits<double>::quiet_NaN();
  /// What it proved that no view in reach exceeds; NaN where it did not.
  double upper_bound = std::numeric_limits<double>::quiet_NaN();
  /// Of the reference's view: as Run::dense_gain. NaN where it is not known.
  double dense_gain = std::numeric_limits<double>::quiet_NaN();

  /// What a view that is not known could add at most, as a share of the bound.
  double gap() const { return upper_bound > 0.0 ? 1.0 - best_known / upper_bound : 0.0; }
};

/// What bounded a run.
struct Budget {
  std::int64_t max_evaluations = 0;  ///< of the exact gain and of the surrogate together; 0: none
  double time_limit_ms = 0.0;        ///< 0: none

  bool operator==(const Budget&) const = default;
};

/// A better view than all before it: a step of the best exact gain.
struct ProgressStep {
  std::int64_t evaluations = 0;        ///< when it was found, of the exact gain and the surrogate
  std::int64_t exact_evaluations = 0;  ///< of these, of the exact gain
  double time_ms = 0.0;                ///< when it was found
  double gain = 0.0;                   ///< exact
};

/// One unit of work: a case, answered by a solver within a budget.
struct Run {
  std::size_t case_index = 0;
  std::size_t solver = 0;
  std::size_t budget = 0;
  std::uint64_t seed = 0;
  std::string failure;        ///< why there is no answer; empty: there is one, below
  double gain = 0.0;          ///< exact, of the answer
  double current_gain = 0.0;  ///< exact, of staying
  /// The exact gain of the answer's view in each uncertainty mode: distance, angle, both.
  std::array<double, 3> gain_by_mode{};
  /// The exact gain of the answer's view with a ray for each pixel of the camera's image; NaN in
  /// older records.
  double dense_gain = std::numeric_limits<double>::quiet_NaN();
  std::int64_t evaluations = 0;  ///< of the exact gain
  std::int64_t surrogate_evaluations = 0;
  double move_time_s = 0.0;
  double search_time_ms = 0.0;
  std::vector<ProgressStep> progress;  ///< ascending in evaluations, time and gain; staying first

  bool has_failed() const { return !failure.empty(); }
};

/// What answers are measured against.
enum class Against {
  best_known,   ///< the best exact gain that the reference search found
  upper_bound,  ///< what it proved that no view exceeds
};

struct Results {
  std::string study;  ///< its name
  Against against = Against::best_known;
  std::vector<CaseResult> cases;
  std::vector<std::string> solvers;  ///< the first is the one that the others are compared with
  std::vector<Budget> budgets;       ///< from tight to loose, evaluations before times
  std::vector<Run> runs;             ///< sorted by case, solver, budget and seed
  std::size_t missing_runs = 0;      ///< units of the study that have no record yet
};

}  // namespace nbvopt::study
