#include "web/view_gains.hpp"

#include <algorithm>
#include <cmath>

#include "web/packed.hpp"
#include "web/voxel_gains.hpp"

namespace nbvopt {
namespace {

void add_landscape(const AnswerFile& answer, const ViewPlanner& planner, int threads,
                   const StopRule& stop, ViewGains& gains) {
  PlanResult result;
  result.request = answer.request;
  result.joints = answer.joints;
  result.box = planner.reachable_box(answer.request);
  const Landscape landscape = planner.landscape(result, threads, stop);
  const auto was_left_out = [](double gain) { return std::isnan(gain); };
  if (std::ranges::any_of(landscape.gain, was_left_out)) return;
  gains.data["landscape"] = {{"height_m", landscape.height_m},
                             {"pan_rad", landscape.pan_rad},
                             {"tilt_rad", landscape.tilt_rad}};
  gains.blocks.push_back({"landscape-gains", packed_numbers(landscape.gain)});
}

void add_voxel_gains(const AnswerFile& answer, const ViewPlanner& planner, ViewGains& gains) {
  Json& told = gains.data["voxel_gains"] = {{"gain", to_string(planner.robot().sensor.gain)}};
  if (planner.evaluator() != "exact") {
    told["why_none"] = "the evaluator " + planner.evaluator() + " does not tell what voxels bring";
    return;
  }
  const VoxelGains by_voxel =
      voxel_gains(planner.grid(), planner.robot().sensor, planner.hazards(),
                  T_map_sensor(answer.request, planner.mast(), answer.joints));
  if (!by_voxel.why_none.empty()) {
    told["why_none"] = by_voxel.why_none;
    return;
  }
  std::vector<double> numbers;
  for (const VoxelGain& voxel : by_voxel.voxels) {
    numbers.insert(
        numbers.end(),
        {static_cast<double>(voxel.key.x), static_cast<double>(voxel.key.y),
         static_cast<double>(voxel.key.z), voxel.gain, static_cast<double>(voxel.state)});
  }
  gains.blocks.push_back({"voxel-gains", packed_numbers(numbers)});
}

}  // namespace

ViewGains view_gains(const AnswerFile& answer, const ViewPlanner& planner, int threads,
                     const StopRule& stop) {
  ViewGains gains;
  add_landscape(answer, planner, threads, stop, gains);
  add_voxel_gains(answer, planner, gains);
  return gains;
}

}  // namespace nbvopt
