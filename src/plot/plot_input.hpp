// What the picture of an answer is drawn from.
#pragma once

#include <vector>

#include "nbvopt/planner/view_planner.hpp"

namespace nbvopt {

/// An answer, and what it stands on.
struct PlotInput {
  const ViewPlanner& planner;
  const PlanResult& result;                     ///< the planner's, with its trace
  const Landscape& landscape;                   ///< around it
  std::vector<double> candidate_pans_rad = {};  ///< the pans of the paper's grid
};

}  // namespace nbvopt
