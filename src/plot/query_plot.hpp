// The picture of an answer: what the robot knows around it, where its camera looks and should
// look, what other pan and tilt angles would have gained, and how the search went.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/planner/planner.hpp"
#include "nbvopt/planner/robot.hpp"
#include "planner/landscape.hpp"

namespace nbvopt {

/// A question with its answer, and what they stand on. `result` is one of Planner::plan().
struct PlotInput {
  const VoxelGrid& grid;
  const ViewEvaluator& evaluator;  ///< judges the pan angles of the gain chart
  const Robot& robot;
  const PlanRequest& request;
  const PlanResult& result;  ///< with its trace
  const GainLandscape& landscape;
  std::vector<double> candidate_pans_rad = {};  ///< the pans of the paper's grid
};

/// Draws the picture: the bytes of a PNG file.
std::string plot_png(const PlotInput& input);

/// The same as a file, whole or not at all. Throws InputError when it cannot be written.
void write_plot(const PlotInput& input, const std::filesystem::path& path);

}  // namespace nbvopt
