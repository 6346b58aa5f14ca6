#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "nbvopt/gain/view_evaluator.hpp"

namespace nbvopt {

std::vector<ViewGain> evaluate_views(const ViewEvaluator& evaluator,
                                     std::span<const Transform> poses_T_map_sensor, int threads,
                                     const StopRule& stop) {
  std::vector<ViewGain> gains(poses_T_map_sensor.size());
  const auto evaluate_one = [&](std::size_t i) {
    if (stop.cancel.is_cancelled() || stop.is_expired()) return;
    gains[i] = evaluator.evaluate(poses_T_map_sensor[i]);
  };
  if (threads == 1) {
    for (std::size_t i = 0; i < gains.size(); ++i) evaluate_one(i);
    return gains;
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, gains.size(), evaluate_one); });
  return gains;
}

}  // namespace nbvopt
