// What a page tells of gains around an answer: over pan and tilt, and by voxel.
#pragma once

#include <vector>

#include "core/json.hpp"
#include "nbvopt/core/stop.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "web/answer_file.hpp"
#include "web/page.hpp"

namespace nbvopt {

/// Members of a page's data and its blocks. `landscape` is missing where it was not done in time;
/// `voxel_gains` has `why_none` where voxels have no part in the gain.
struct ViewGains {
  Json data = Json::object();
  std::vector<PageBlock> blocks;
};

/// Judged by the planner on the map that it has, on so many threads (0: one a core). Throws
/// InputError where the answer's request cannot be one to the planner's robot.
ViewGains view_gains(const AnswerFile& answer, const ViewPlanner& planner, int threads = 0,
                     const StopRule& stop = {});

}  // namespace nbvopt
