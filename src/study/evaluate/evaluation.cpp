#include "study/evaluate/evaluation.hpp"

namespace nbvopt::study {

Evaluation evaluate(const Results& results) {
  return {.budget = loosest_budget(results),
          .summaries = summarise(results),
          .running_times = expected_running_times(results, {0.95, 0.99, 0.999}),
          .performance = performance_profiles(results, kProfileTarget),
          .data = data_profiles(results, data_profile_targets()),
          .cycles = cycles(results),
          .best_motion_times = best_motion_times(results),
          .modes = compare_modes(results),
          .comparisons = compare_with_control(results),
          .excess = excess_over_reference(results),
          .dense = summarise_dense(results),
          .dense_ratio_of_references = dense_ratio_of_references(results)};
}

}  // namespace nbvopt::study
